//! Measurements as lines for people.

use lightsquare::job::{
    Estimate, Fault, Flaw, GameMeasurement, Measurement, PlanSummary, Verdict, in_bytes,
};
use lightsquare::text::printable;

/// Of the thesis's settings.
pub fn pictures(measurements: &[Measurement]) -> String {
    let mut lines = String::from(
        "start position, 1000x600          seconds   thesis    times   primary    shadow reflected  Mrays/s/core\n",
    );
    for Measurement { setting, seconds, thesis_seconds, rays, mrays_per_second_and_core, .. } in
        measurements
    {
        let times = thesis_seconds / seconds;
        lines += &format!(
            "{setting:32} {seconds:8.3} {thesis_seconds:8.0} {times:8.0} {:9} {:9} {:9} {mrays_per_second_and_core:13.2}\n",
            rays.primary, rays.shadow, rays.reflected,
        );
    }
    lines
}

/// Of a game; nothing where none was measured.
pub fn games(measurements: &[GameMeasurement]) -> String {
    if measurements.is_empty() {
        return String::new();
    }
    let mut lines = String::from(
        "\na game, seconds a frame               frames   whole*    reuse    times  frames/s\n",
    );
    for measurement in measurements {
        let GameMeasurement { setting, frames, whole_seconds, reuse_seconds, times, .. } =
            measurement;
        let rate = 1.0 / reuse_seconds;
        lines += &format!(
            "{setting:37} {frames:6} {whole_seconds:8.4} {reuse_seconds:8.4} {times:8.1} {rate:9.1}\n",
        );
    }
    lines
        + "* of every n-th frame, ten at most; reuse begins with a whole frame, so few plies say less of it\n"
}

/// What a job would take.
pub fn estimate(estimate: &Estimate) -> String {
    let Estimate { games, frames, bytes, seconds, threads, .. } = estimate;
    format!(
        "games: {games}; frames: {frames}; about {} of pictures, and {} with {threads} threads",
        in_bytes(*bytes),
        time(*seconds)
    )
}

fn time(seconds: f64) -> String {
    match seconds.max(0.0) {
        seconds if seconds < 9.95 => format!("{seconds:.1} s"),
        seconds if seconds < 100.0 => format!("{seconds:.0} s"),
        seconds if seconds < 6000.0 => format!("{:.0} min", seconds / 60.0),
        seconds if seconds < 360_000.0 => format!("{:.0} h", seconds / 3600.0),
        seconds => format!("{:.0} days", seconds / 86_400.0),
    }
}

/// What a plan came to.
pub fn plan(planned: &PlanSummary) -> String {
    let PlanSummary {
        shards,
        smallest,
        largest,
        within_lines,
        within_moves,
        estimate: whole,
        cost,
    } = planned;
    let share = 100.0 * cost / whole.seconds.max(1e-9);
    let torn = match within_moves {
        0 => "",
        _ => " (some of them within a move)",
    };
    let cut = match within_lines {
        0 if *shards == 1 => "all is in one".to_owned(),
        0 => "each begins with a game, so the cuts cost no tracing".to_owned(),
        _ => format!(
            "{within_lines} of them {} within a game{torn}, which costs {} more at most, {share:.1} %",
            if *within_lines == 1 { "begins" } else { "begin" },
            time(*cost)
        ),
    };
    format!(
        "{}\nshards: {shards}, of {smallest} to {largest} frames, about {} each; {cut}",
        estimate(whole),
        time((whole.seconds + cost) / *shards as f64)
    )
}

/// Numbers of tasks as `sbatch` takes them: `--array=0-3,7`.
pub fn array(shards: &[usize]) -> String {
    let mut ranges: Vec<[usize; 2]> = Vec::new();
    for shard in shards {
        match ranges.last_mut() {
            Some([_, last]) if *last + 1 == *shard => *last = *shard,
            _ => ranges.push([*shard, *shard]),
        }
    }
    let ranges = ranges.iter().map(|[first, last]| match first == last {
        true => first.to_string(),
        false => format!("{first}-{last}"),
    });
    format!("--array={}", ranges.collect::<Vec<_>>().join(","))
}

/// What is wrong with the pictures of a plan: the tasks to start again, then a row for each run of pictures.
pub fn verdict(verdict: &Verdict) -> String {
    let mut lines = array(&verdict.shards());
    for Fault { shard, folder, first, last, flaw } in &verdict.faults {
        let folder = printable(&folder.to_string_lossy());
        let numbers = if first == last { first.to_string() } else { format!("{first}-{last}") };
        let flaw = match flaw {
            Flaw::Missing => "missing",
            Flaw::Broken => "broken",
        };
        lines += &format!("\n{shard}\t{folder}\t{numbers}\t{flaw}");
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_of_an_array_are_one_range() {
        for (shards, expected) in [
            (vec![0], "--array=0"),
            (vec![0, 1, 2, 3], "--array=0-3"),
            (vec![1, 3, 4, 9], "--array=1,3-4,9"),
        ] {
            assert_eq!(array(&shards), expected);
        }
    }
}
