//! Variations as lines of their own, with names.

use std::collections::{BTreeMap, VecDeque};

use shakmaty::Position;

use super::{Game, Ply, Variation};

/// Where a variation is found in its game, and what it is called there.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Branch {
    /// The variation's number among those of the main line, then that of one of its own
    /// variations, and so on; all from 0.
    pub path: Vec<usize>,
    /// A name for each of them: the moment and the move that begin it, as in `12w-nf3`. Its
    /// characters are `a-z0-9-`; those that begin alike in one line are told apart by `-2`, `-3`, ….
    pub names: Vec<String>,
}

impl Game {
    /// All variations that have a move, those of the main line before those within them.
    pub fn branches(&self) -> impl Iterator<Item = Branch> + '_ {
        let mut waiting = VecDeque::from(branches(&Branch::default(), &self.variations));
        std::iter::from_fn(move || {
            let (branch, variation) = waiting.pop_front()?;
            waiting.extend(branches(&branch, &variation.variations));
            Some(branch)
        })
    }

    /// The variation at a branch's path, if it is there.
    pub fn variation(&self, path: &[usize]) -> Option<&Variation> {
        let (first, within) = path.split_first()?;
        within.iter().try_fold(self.variations.get(*first)?, |variation, index| {
            variation.variations.get(*index)
        })
    }

    /// The game as it would have gone: up to where the variation at `path` begins, and then on
    /// with that. Its variations are those of that line, and so are its problems; its result is
    /// open, and no tag tells another. `None` if there is no such variation.
    pub fn with_variation(&self, path: &[usize]) -> Option<Game> {
        let mut plies = self.plies.clone();
        let (mut variations, mut problems) = (&self.variations, &self.problems);
        for index in path {
            let variation = variations.get(*index)?;
            plies.truncate(variation.ply);
            plies.extend(variation.plies.iter().cloned());
            (variations, problems) = (&variation.variations, &variation.problems);
        }
        Some(Game {
            plies,
            variations: variations.clone(),
            problems: problems.clone(),
            result: "*".to_owned(),
            tags: self.tags.iter().filter(|(name, _)| !tells_end(name)).cloned().collect(),
            unread_tags: self.unread_tags.clone(),
            start: self.start.clone(),
            start_notes: self.start_notes.clone(),
            ..*self
        })
    }
}

/// Whether a tag of that name says how the game ended, which a variation has not done.
fn tells_end(name: &str) -> bool {
    ["Result", "Termination"].iter().any(|known| known.eq_ignore_ascii_case(name))
}

/// The variations of a line that have a move.
fn branches<'a>(line: &Branch, variations: &'a [Variation]) -> Vec<(Branch, &'a Variation)> {
    let mut seen = BTreeMap::new();
    let mut branches = Vec::new();
    for (index, variation) in variations.iter().enumerate() {
        let Some(first) = variation.plies.first() else {
            continue;
        };
        let name = name(first);
        let times = seen.entry(name.clone()).or_insert(0);
        *times += 1;
        let mut branch = line.clone();
        branch.path.push(index);
        branch.names.push(if *times == 1 { name } else { format!("{name}-{times}") });
        branches.push((branch, variation));
    }
    branches
}

/// What a variation that begins with `ply` is called.
fn name(ply: &Ply) -> String {
    let san = ply.san.to_string().to_ascii_lowercase();
    let san: String = san.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    format!("{}{}-{san}", ply.number(), ply.mover().char())
}

impl Ply {
    /// Who made the move.
    pub fn mover(&self) -> shakmaty::Color {
        self.after.turn().other()
    }

    /// The number of the move, as the position counts.
    pub fn number(&self) -> u32 {
        let next = self.after.fullmoves().get();
        self.mover().fold_wb(next, next.saturating_sub(1))
    }
}
