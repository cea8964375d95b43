//! A game frame by frame, with what stood still reused, beside whole renders.

use std::time::Instant;

use serde::Serialize;

use super::BenchJob;
use crate::assets::SetName;
use crate::config::{Config, Look, Quality, View};
use crate::game::{Game, Scanner};
use crate::job::settings::PictureSettings;
use crate::job::studio::Studio;
use crate::job::{JobError, Showing};
use crate::timeline::{Film, Pause, Timeline};

/// What the frames of a game took.
#[derive(Clone, Debug, Serialize)]
pub struct GameMeasurement {
    pub setting: &'static str,
    pub frames: usize,
    /// Of a frame that is rendered whole: the mean over every n-th, ten of them at most.
    pub whole_seconds: f64,
    /// Of a frame that reuses what stood still since the one before: the mean over all.
    pub reuse_seconds: f64,
    /// How many times the first is as long as the second.
    pub times: f64,
    pub threads: usize,
}

/// Kasparov – Topalov, Wijk aan Zee 1999: 87 half-moves.
const GAME: &str = include_str!("../../../games/kasparov-topalov-1999.pgn");

/// With its frames at moments one after the other: a position, and then eight of the move that leaves it.
const FILM: Film = Film {
    fps: 1.0,
    transition: 8.0,
    pause: Pause::Even(1.0),
    first: 0.5,
    last: 1.5,
    title: 0.0,
    result: 0.0,
};

/// At most so many frames are rendered whole, and at most one a position.
const SAMPLES: usize = 10;

/// What is measured: name, look, view, and whether there are frames between the positions.
const SETTINGS: [(&str, Look, View, bool); 5] = [
    ("thesis, a frame a ply", Look::Thesis, View::Thesis, false),
    ("thesis, 8 frames between", Look::Thesis, View::Thesis, true),
    ("thesis from above, a frame a ply", Look::Thesis, View::Top, false),
    ("thesis from above, 8 frames between", Look::Thesis, View::Top, true),
    ("default look, 8 frames between", Look::Studio, View::White, true),
];

/// Renders the game: in the thesis's look with its set at 1000 × 600 with 4 rays a pixel; and in the default
/// look with its set at 1280 × 720, as good as for films.
///
/// # Errors
/// When threads cannot be started.
pub fn measure(job: &BenchJob) -> Result<Vec<GameMeasurement>, JobError> {
    let Some(game) = game().filter(|_| job.plies > 0) else {
        return Ok(Vec::new());
    };
    let measure = |(setting, look, view, animate)| {
        let mut config = Config::new(look);
        Quality::Normal.apply(&mut config.render);
        config.camera.view = view;
        let set = match look {
            Look::Thesis => SetName::Thesis,
            Look::Studio => SetName::Staunton,
        };
        if look == Look::Studio {
            (config.width, config.height) = (1280, 720);
        }
        let showing = Showing { film: FILM, animate, ..Showing::default() };
        let picture = PictureSettings { config, config_file: None, set, threads: job.threads };
        film(setting, &game, &showing, &picture, job)
    };
    SETTINGS.into_iter().map(measure).collect()
}

fn game() -> Option<Game> {
    Some(Game::read(Scanner::new(GAME.as_bytes()).next()?.ok()?, 1))
}

/// Renders a film of `game`.
fn film(
    setting: &'static str,
    game: &Game,
    showing: &Showing,
    picture: &PictureSettings,
    job: &BenchJob,
) -> Result<GameMeasurement, JobError> {
    let reach = showing.reach(&picture.config);
    let studio = || Studio::new(picture, reach);
    let script = showing.script(&picture.config, studio()?.bodies().clone());
    let plies = job.plies.min(game.plies.len());
    let timeline = Timeline::new(game, 0, plies, &script).map_err(|error| JobError::Path {
        file: setting.to_owned(),
        game: game.number,
        error,
    })?;
    let frames: Vec<_> = (0..timeline.frames()).map(|index| timeline.frame(index)).collect();
    let samples: Vec<_> =
        frames.iter().step_by(frames.len().div_ceil(SAMPLES.min(plies + 1))).collect();
    let pool = picture.pool()?;
    let mut studio = studio()?;
    let begin = Instant::now();
    pool.install(|| samples.iter().for_each(|frame| drop(studio.trace_whole(frame))));
    let whole = begin.elapsed().as_secs_f64() / samples.len() as f64;
    let begin = Instant::now();
    pool.install(|| {
        for (index, frame) in frames.iter().enumerate() {
            studio.trace(frame, frames[index + 1..].iter().cloned());
        }
    });
    let reuse = begin.elapsed().as_secs_f64() / frames.len() as f64;
    Ok(GameMeasurement {
        setting,
        frames: frames.len(),
        whole_seconds: whole,
        reuse_seconds: reuse,
        times: whole / reuse,
        threads: pool.current_num_threads(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_game_is_whole_and_has_eight_frames_between_its_positions() {
        let game = game().unwrap();
        assert!(game.is_whole());
        assert_eq!(game.plies.len(), 87);
        for (animate, frames) in [(false, 88), (true, 784)] {
            let showing = Showing { film: FILM, animate, ..Showing::default() };
            let script = showing.script(&Config::new(Look::Thesis), Default::default());
            let timeline = Timeline::new(&game, 0, 87, &script).unwrap();
            assert_eq!(timeline.frames(), frames);
            let per_ply = frames / 87;
            for index in 0..frames {
                let is_at_rest = timeline.frame(index).movers.is_empty();
                assert_eq!(is_at_rest, index % per_ply == 0, "{index}");
            }
        }
    }

    #[test]
    fn all_frames_are_rendered_by_reuse_and_some_whole() {
        let mut config = Config::new(Look::Thesis);
        (config.width, config.height) = (16, 9);
        let set = SetName::Thesis;
        let picture = PictureSettings { config, config_file: None, set, threads: Some(1) };
        let job = BenchJob { threads: Some(1), runs: 2, plies: 2 };
        for (animate, frames) in [(false, 3), (true, 19)] {
            let showing = Showing { film: FILM, animate, ..Showing::default() };
            let measured = film("", &game().unwrap(), &showing, &picture, &job).unwrap();
            assert_eq!(measured.frames, frames);
            let seconds = [measured.whole_seconds, measured.reuse_seconds];
            assert!(seconds.iter().all(|seconds| *seconds > 0.0 && seconds.is_finite()));
        }
    }
}
