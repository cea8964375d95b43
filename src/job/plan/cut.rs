//! Where shards begin: as near as can be to equal numbers of frames, and where reuse loses least.
//!
//! The first frame of a shard is traced whole. So is that of a line of play, a game's or a variation's: a cut there costs
//! nothing. A cut within one costs a whole frame; where a position begins to stand, at least no move is torn.

use std::ops::Range;

/// What a shard begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seam {
    /// The first frame of a line.
    Line,
    /// A position that begins to stand.
    Position,
    /// Any other frame.
    Frame,
}

/// Cuts so many frames, which come line by line, into shards.
pub struct Cutter {
    frames: u64,
    shards: u64,
    /// The shard whose beginning is to be found.
    next: u64,
}

impl Cutter {
    /// The first shard begins with the first frame.
    pub fn new(frames: u64, shards: usize) -> Cutter {
        Cutter { frames, shards: shards as u64, next: 1 }
    }

    /// The shards whose even share begins in `line`: with which frame they had better begin, in their order. It lies in
    /// `line`, or is the one behind it.
    pub fn cut(&mut self, line: Range<u64>, stands: impl Fn(u64) -> bool) -> Vec<(u64, Seam)> {
        // Two cuts that go towards each other leave half a share.
        let room = self.frames / self.shards / 4;
        let mut cuts = Vec::new();
        while self.next < self.shards {
            // Both are far below 2^40.
            let even = self.frames * self.next / self.shards;
            if even >= line.end {
                break;
            }
            self.next += 1;
            let is_near = |at: &u64| at.abs_diff(even) <= room && *at < self.frames;
            let ends = [line.start, line.end].into_iter().filter(is_near);
            let end = ends.min_by_key(|at| at.abs_diff(even)).map(|at| (at, Seam::Line));
            let position = || {
                let near = |distance| [even.checked_sub(distance), Some(even + distance)];
                let near = (0..=room).flat_map(near).flatten();
                let mut near = near.filter(|at| line.contains(at) && stands(*at));
                near.next().map(|at| (at, Seam::Position))
            };
            let cut = end.or_else(position);
            cuts.push(cut.unwrap_or((even, Seam::Frame)));
        }
        cuts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cuts lines of such lengths, where every tenth frame of each is a position that begins to stand.
    fn cuts(lines: &[u64], shards: usize) -> Vec<(u64, Seam)> {
        let mut cutter = Cutter::new(lines.iter().sum(), shards);
        let mut start = 0;
        let mut found = Vec::new();
        for length in lines {
            let line = start..start + length;
            found.extend(cutter.cut(line, |at| (at - start) % 10 == 0));
            start += length;
        }
        found
    }

    #[test]
    fn shards_begin_with_lines_then_with_positions() {
        use Seam::{Frame, Line, Position};
        for (lines, shards, expected) in [
            (vec![100], 1, vec![]),
            (vec![50, 50], 2, vec![(50, Line)]),
            // Within a quarter of a share, the nearer end of a line.
            (vec![45, 55], 2, vec![(45, Line)]),
            (vec![60, 40], 2, vec![(60, Line)]),
            (vec![30, 70], 2, vec![(50, Position)]),
            (vec![106], 2, vec![(50, Position)]),
            (vec![104], 2, vec![(50, Position)]),
            // A share is too short for a choice.
            (vec![9], 3, vec![(3, Frame), (6, Frame)]),
            (vec![1; 6], 3, vec![(2, Line), (4, Line)]),
            // More shards than frames: some have nothing.
            (vec![2], 4, vec![(0, Line), (1, Frame), (1, Frame)]),
        ] {
            assert_eq!(cuts(&lines, shards), expected, "{lines:?} in {shards}");
        }
    }

    #[test]
    fn every_shard_has_frames_and_about_an_even_share() {
        for frames in 1..200_u64 {
            for shards in 1..=frames.min(40) as usize {
                let lines = [frames / 3, frames - frames / 3];
                let begins: Vec<u64> = cuts(&lines, shards).into_iter().map(|(at, _)| at).collect();
                let mut all = vec![0];
                all.extend(&begins);
                all.push(frames);
                assert_eq!(all.len(), shards + 1, "{frames} in {shards}");
                let share = frames as f64 / shards as f64;
                for pair in all.windows(2) {
                    let found = (pair[1] - pair[0]) as f64;
                    assert!(pair[0] < pair[1], "{frames} in {shards}: {all:?}");
                    assert!((share / 2.0 - 1.0..=share * 1.5 + 1.0).contains(&found), "{all:?}");
                }
            }
        }
    }
}
