//! What pixels depend on.

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene::Cells;

/// How many bodies may come and go.
pub const MEMBERS: usize = 128;

/// Words for cells, and for members.
const CELLS: usize = 2;
const WORDS: usize = CELLS + MEMBERS / 32;

/// A set of cells, for what is painted on them, and of a cast's members.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ties([u32; WORDS]);

impl Ties {
    /// The `cells` whose bits are set, row by row, and `members` by number.
    pub fn new(cells: u64, members: u128) -> Ties {
        let mut ties = Ties::default();
        for (index, word) in ties.0.iter_mut().enumerate() {
            *word = match index.checked_sub(CELLS) {
                None => (cells >> (32 * index)) as u32,
                Some(index) => (members >> (32 * index)) as u32,
            };
        }
        ties
    }

    pub fn add(&mut self, other: &Ties) {
        self.0.iter_mut().zip(other.0).for_each(|(word, other)| *word |= other);
    }

    /// Whether the two sets have anything in common.
    pub fn meet(&self, other: &Ties) -> bool {
        self.0.iter().zip(other.0).fold(0, |any, (word, other)| any | (word & other)) != 0
    }

    pub fn is_empty(&self) -> bool {
        *self == Ties::default()
    }
}

/// The sum of several sets.
impl<'a> FromIterator<&'a Ties> for Ties {
    fn from_iter<T: IntoIterator<Item = &'a Ties>>(sets: T) -> Ties {
        sets.into_iter().fold(Ties::default(), |mut all, ties| {
            all.add(ties);
            all
        })
    }
}

/// What eight rays, and those that come of them, depend on.
pub struct Ties8<S: Simd> {
    words: [U32x8<S>; WORDS],
}

/// Stands for what is no member.
pub const NO_MEMBER: u32 = u32::MAX;

impl<S: Simd> Ties8<S> {
    #[inline(always)]
    pub fn new() -> Ties8<S> {
        Ties8 { words: [U32x8::splat(0); WORDS] }
    }

    /// What they depend on already.
    #[inline(always)]
    pub fn load(ties: &[Ties; 8]) -> Ties8<S> {
        let mut words = [[0; 8]; WORDS];
        for (lane, ties) in ties.iter().enumerate() {
            for (word, tie) in words.iter_mut().zip(ties.0) {
                word[lane] = tie;
            }
        }
        let mut all = Ties8::new();
        for (word, lanes) in all.words.iter_mut().zip(&words) {
            *word = U32x8::load(lanes);
        }
        all
    }

    #[inline(always)]
    pub fn store(&self) -> [Ties; 8] {
        let mut ties = [Ties::default(); 8];
        for (index, word) in self.words.iter().enumerate() {
            for (ties, word) in ties.iter_mut().zip(word.store()) {
                ties.0[index] = word;
            }
        }
        ties
    }

    /// Adds one member to some lanes.
    #[inline(always)]
    pub fn add(&mut self, member: u32, lanes: Mask8<S>) {
        if (member as usize) < MEMBERS {
            let word = &mut self.words[CELLS + member as usize / 32];
            let bit = U32x8::splat(1 << (member % 32));
            *word = *word | lanes.select_words(bit, U32x8::splat(0));
        }
    }

    /// Which lanes have a member.
    #[inline(always)]
    pub fn have(&self, member: u32) -> Mask8<S> {
        let bit = U32x8::splat(1 << (member % 32));
        (self.words[CELLS + member as usize / 32 % (MEMBERS / 32)] & bit).eq(bit)
    }

    /// Adds to each of some lanes a member, or none.
    #[inline(always)]
    pub fn add_each(&mut self, members: U32x8<S>, lanes: Mask8<S>) {
        let bit = U32x8::splat(1) << (members & U32x8::splat(31));
        let word_of_each = members >> 5;
        for index in 0..WORDS - CELLS {
            let lanes = lanes & word_of_each.eq(U32x8::splat(index as u32));
            let word = &mut self.words[CELLS + index];
            *word = *word | lanes.select_words(bit, U32x8::splat(0));
        }
    }

    /// Adds the cells that lie under `points`; the nearest, beside them.
    #[inline(always)]
    pub fn add_cells(&mut self, cells: &Cells, points: Vec3x8<S>, lanes: Mask8<S>) {
        let number = F32x8::splat;
        let Cells { origin, side, .. } = *cells;
        let scale = number(1.0 / side as f32);
        let column = (points.x - number(origin.x as f32)) * scale + number(0.5);
        let row = (points.z - number(origin.y as f32)) * scale + number(0.5);
        let (column, row) = (column.floor().clamp(0.0, 7.0), row.floor().clamp(0.0, 7.0));
        let cell = (row.to_i32() << 3) + column.to_i32();
        let bit = U32x8::splat(1) << (cell & U32x8::splat(31));
        let is_first = cell.below(U32x8::splat(32));
        let zero = U32x8::splat(0);
        self.words[0] = self.words[0] | (lanes & is_first).select_words(bit, zero);
        self.words[1] = self.words[1] | lanes.but(is_first).select_words(bit, zero);
    }
}
