//! The camera's path through key frames.

use super::film::Schedule;
use crate::config::{KeyFrame, Pose, When};
use crate::game::{Game, Moment};
use crate::notation::Color;

/// Why a camera's path cannot be taken in a game.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PathError {
    #[error(
        "[CameraPath]: the key frame `{later}` comes at {later_time:.2} s, and `{earlier}` before it at \
         {earlier_time:.2} s, expected each later than the one before"
    )]
    OutOfOrder { earlier: When, earlier_time: f64, later: When, later_time: f64 },
    #[error(
        "[CameraPath]: between `{from}` and `{to}` the camera goes through the point that it looks at, \
         expected a way round it"
    )]
    ThroughLookAt { from: When, to: When },
}

/// A smooth way through poses.
#[derive(Clone, Debug)]
pub struct Path {
    /// In seconds, ascending; at least one.
    times: Vec<f64>,
    poses: Vec<Values>,
    /// The change a second at each of them.
    slopes: Vec<Values>,
}

/// Position, look-at, FOV and roll of a pose.
type Values = [f64; 8];

/// Looks between two key frames.
const LOOKS: u32 = 64;

/// World units; nearer to the point that it looks at a camera has no direction.
const NEAREST: f64 = 1e-3;

impl Path {
    /// The path through `keys` in `game` from ply `first` on, at the times of `schedule`.
    ///
    /// # Errors
    /// Key frames that are not in the order of their times; a path on which the camera has no direction.
    pub fn new(
        keys: &[KeyFrame],
        game: &Game,
        first: usize,
        schedule: &Schedule,
    ) -> Result<Path, PathError> {
        // Who says `end` means it, even where a game, or a variation, ends before a move that is named.
        let has_end = keys.last().is_some_and(|key| key.at == When::End);
        let ends = |key: &&KeyFrame| {
            let moment = moment(key.at).filter(|_| key.at != When::End);
            moment.is_some_and(|moment| moment.counted(game) >= game.plies.len() as i64)
        };
        let keys: Vec<KeyFrame> =
            keys.iter().filter(|key| !(has_end && ends(key))).copied().collect();
        let times: Vec<f64> = keys.iter().map(|key| time(key.at, game, first, schedule)).collect();
        for (keys, times) in keys.windows(2).zip(times.windows(2)) {
            if times[1] <= times[0] {
                return Err(PathError::OutOfOrder {
                    earlier: keys[0].at,
                    earlier_time: times[0],
                    later: keys[1].at,
                    later_time: times[1],
                });
            }
        }
        let poses: Vec<Values> = keys.iter().map(|key| values(&key.pose)).collect();
        let slopes = slopes(&times, &poses);
        let path = Path { times, poses, slopes };
        for (keys, times) in keys.windows(2).zip(path.times.windows(2)) {
            let meets = |look: u32| {
                let share = f64::from(look) / f64::from(LOOKS);
                let pose = path.pose(times[0] + (times[1] - times[0]) * share);
                pose.position.distance(pose.look_at) < NEAREST
            };
            if (0..=LOOKS).any(meets) {
                return Err(PathError::ThroughLookAt { from: keys[0].at, to: keys[1].at });
            }
        }
        Ok(path)
    }

    /// The pose at a time in seconds; before the first key frame and behind the last one it stands still.
    pub fn pose(&self, time: f64) -> Pose {
        let last = self.times.len() - 1;
        let next = self.times.partition_point(|key| *key <= time);
        if next == 0 || next > last {
            return pose(self.poses[next.min(last)]);
        }
        let (from, to) = (next - 1, next);
        let step = self.times[to] - self.times[from];
        let t = (time - self.times[from]) / step;
        // Hermite's cubic.
        let (early, late) = ((1.0 - t) * (1.0 - t), t * t);
        let value = |index: usize| {
            self.poses[from][index] * early * (1.0 + 2.0 * t)
                + self.poses[to][index] * late * (3.0 - 2.0 * t)
                + self.slopes[from][index] * step * t * early
                - self.slopes[to][index] * step * late * (1.0 - t)
        };
        pose(std::array::from_fn(value))
    }
}

/// When a key frame is, in seconds from the film's beginning.
fn time(at: When, game: &Game, first: usize, schedule: &Schedule) -> f64 {
    match (at, moment(at)) {
        (_, Some(moment)) => schedule.reached(moment.counted(game) - first as i64),
        (When::Seconds(seconds), None) => seconds,
        (_, None) => 0.0,
    }
}

/// The position that a time names, if it does.
fn moment(at: When) -> Option<Moment> {
    match at {
        When::Seconds(_) => None,
        When::Start => Some(Moment::Ply(0)),
        When::End => Some(Moment::End),
        When::After { number, is_blacks } => {
            Some(Moment::After(number, Color::from_white(!is_blacks)))
        }
    }
}

fn values(pose: &Pose) -> Values {
    let Pose { position: p, look_at: l, fov, z_rot } = pose;
    [p.x, p.y, p.z, l.x, l.y, l.z, *fov, *z_rot]
}

fn pose([x, y, z, lx, ly, lz, fov, z_rot]: Values) -> Pose {
    Pose { position: [x, y, z].into(), look_at: [lx, ly, lz].into(), fov, z_rot }
}

/// The slopes of smooth curves that never leave the range of the two key frames they are between
/// (Fritsch and Butland 1984): the weighted harmonic mean of the slopes on both sides, and none at turning
/// points and ends.
fn slopes(times: &[f64], poses: &[Values]) -> Vec<Values> {
    let slope = |key: usize, index: usize| {
        if key == 0 || key + 1 == times.len() {
            return 0.0;
        }
        let [before, after] = [key - 1, key].map(|from| {
            let step = times[from + 1] - times[from];
            (step, (poses[from + 1][index] - poses[from][index]) / step)
        });
        if before.1 * after.1 <= 0.0 {
            return 0.0;
        }
        let (early, late) = (2.0 * after.0 + before.0, after.0 + 2.0 * before.0);
        (early + late) / (early / before.1 + late / after.1)
    };
    (0..times.len()).map(|key| std::array::from_fn(|index| slope(key, index))).collect()
}
