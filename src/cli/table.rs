//! Measurements as lines for people.

use lightsquare::job::{Estimate, GameMeasurement, Measurement, in_bytes};

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
    let Estimate { games, frames, bytes, seconds, threads } = estimate;
    let time = match seconds.max(0.0) {
        seconds if seconds < 100.0 => format!("{seconds:.0} s"),
        seconds if seconds < 6000.0 => format!("{:.0} min", seconds / 60.0),
        seconds if seconds < 360_000.0 => format!("{:.0} h", seconds / 3600.0),
        seconds => format!("{:.0} days", seconds / 86_400.0),
    };
    format!(
        "games: {games}; frames: {frames}; about {} of pictures, and {time} with {threads} threads",
        in_bytes(*bytes)
    )
}
