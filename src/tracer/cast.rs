//! The bodies that come and go in a row of pictures.

use std::borrow::Cow;

use glam::{DAffine3, DVec3};

use super::ties::{MEMBERS, Ties};
use crate::geometry::{Bounds, Placed, Solid};
use crate::scene::{Object, Scene, repainted};

/// Whether two pictures differ by no more than bodies that come and go, and what is painted on others.
fn is_alike(one: &Scene, other: &Scene) -> bool {
    one.camera == other.camera
        && one.cells == other.cells
        && one.lights == other.lights
        && one.room == other.room
        && one.background == other.background
        && one.max_depth == other.max_depth
        && one.min_weight == other.min_weight
        && one.max_distance == other.max_distance
        && one.snell_index == other.snell_index
}

/// The bodies of a row of pictures.
pub struct Cast {
    /// The first picture.
    first: Scene,
    /// Those that are in all pictures.
    fixed: Vec<Object>,
    /// All others, by number.
    members: Vec<Object>,
    /// By picture: the members that are in it, by bits, and those that are in it or in any after it.
    present: Vec<u128>,
    awaited: Vec<u128>,
    /// The picture that is made.
    now: usize,
    /// 1, but in a test.
    share: f64,
}

impl Cast {
    /// The cast of `scene` and of as many of those that are `coming` as it has room for.
    pub fn new(scene: &Scene, coming: impl Iterator<Item = Scene>) -> Cast {
        let mut known =
            Known { objects: scene.objects.clone(), goes: vec![false; scene.objects.len()] };
        let mut pictures = vec![(0..scene.objects.len()).collect::<Vec<_>>()];
        for other in coming {
            let picture = if is_alike(scene, &other) { known.admit(&other) } else { None };
            match picture {
                Some(picture) => pictures.push(picture),
                None => break,
            }
        }
        let mut numbers = 0..;
        let numbers: Vec<Option<u32>> =
            known.goes.iter().map(|goes| if *goes { numbers.next() } else { None }).collect();
        let bits = |picture: &Vec<usize>| {
            let members = picture.iter().filter_map(|index| numbers[*index]);
            members.fold(0, |bits, number| bits | 1_u128 << number)
        };
        let present: Vec<u128> = pictures.iter().map(bits).collect();
        let mut awaited = present.clone();
        for index in (1..present.len()).rev() {
            awaited[index - 1] |= awaited[index];
        }
        let some = |goes: bool| {
            let pairs = known.objects.iter().zip(&known.goes);
            pairs
                .filter(move |(_, other)| **other == goes)
                .map(|(object, _)| object.clone())
                .collect()
        };
        let (fixed, members) = (some(false), some(true));
        Cast { first: scene.clone(), fixed, members, present, awaited, now: 0, share: 1.0 }
    }

    /// For a test: the same, with smaller envelopes.
    pub fn shrunk(self, share: f64) -> Cast {
        Cast { share, ..self }
    }

    /// How many pictures there are.
    pub fn pictures(&self) -> usize {
        self.present.len()
    }

    /// Whether any picture but the first was made.
    pub fn is_of_use(&self) -> bool {
        self.now > 0
    }

    pub fn members(&self) -> &[Object] {
        &self.members
    }

    /// Whether a member is in the picture that is made, or in any after it.
    pub fn awaits(&self, number: u32) -> bool {
        self.awaited[self.now] >> number & 1 == 1
    }

    /// What rays look out for instead of a member: itself.
    pub fn envelope<'a>(&self, member: &'a Object) -> Cow<'a, Object> {
        if self.share == 1.0 {
            return Cow::Borrowed(member);
        }
        let Bounds { min, max } = member.body.bounds();
        let middle = DAffine3::from_translation((min + max) / 2.0);
        let scale = DAffine3::from_scale(DVec3::splat(self.share));
        let place = middle * scale * middle.inverse() * member.body.transform();
        let body = Placed::new(member.body.shared().clone(), place);
        Cow::Owned(Object { body, ..member.clone() })
    }

    /// A member's number.
    pub fn number(&self, object: &Object) -> Option<u32> {
        let found = self.members.iter().position(|member| member.is_same(object));
        found.map(|index| index as u32)
    }

    /// Goes on to `scene`. What stands in it is what is fixed, and members that were there `before` or are in the
    /// next picture; `None` if it is no picture of this cast, or one that is past.
    pub fn stand(&mut self, scene: &Scene, before: u128) -> Option<Stand> {
        let all = self.present_in(scene)?;
        let found = self.present[self.now..].iter().position(|present| *present == all)?;
        self.now += found;
        let stay = before | self.present.get(self.now + 1).unwrap_or(&0);
        let (present, over) = (all & stay, all & !stay);
        let stands =
            |object: &&Object| self.number(object).is_none_or(|number| present >> number & 1 == 1);
        let objects = scene.objects.iter().filter(stands).cloned().collect();
        Some(Stand { scene: Scene { objects, ..scene.clone() }, present, over })
    }

    /// The members that are in `scene`; `None` if there is anything else in it, or anything lacking, or anything
    /// twice.
    fn present_in(&self, scene: &Scene) -> Option<u128> {
        if !is_alike(&self.first, scene) {
            return None;
        }
        let (mut present, mut fixed) = (0, 0);
        for object in &scene.objects {
            match self.number(object) {
                Some(number) if present >> number & 1 == 1 => return None,
                Some(number) => present |= 1 << number,
                None if self.fixed.iter().any(|known| known.is_same(object)) => fixed += 1,
                None => return None,
            }
        }
        (fixed == self.fixed.len()).then_some(present)
    }
}

/// All bodies so far.
struct Known {
    objects: Vec<Object>,
    /// By object: whether any picture lacks it.
    goes: Vec<bool>,
}

impl Known {
    /// Adds the bodies of a picture: their indices. `None`, and nothing has changed, if there is no room.
    fn admit(&mut self, scene: &Scene) -> Option<Vec<usize>> {
        let (count, goes) = (self.objects.len(), self.goes.clone());
        let mut picture = Vec::with_capacity(scene.objects.len());
        // No body may be there twice.
        let (mut seen, mut is_whole) = (vec![false; count], true);
        for object in &scene.objects {
            let known = self.objects.iter().position(|known| known.is_same(object));
            let index = known.unwrap_or(self.objects.len());
            picture.push(index);
            if known.is_none() {
                self.objects.push(object.clone());
                self.goes.push(true);
                seen.push(false);
            }
            is_whole &= !std::mem::replace(&mut seen[index], true);
        }
        self.goes.iter_mut().zip(&seen).for_each(|(goes, is_there)| *goes |= !is_there);
        let changing = || self.objects.iter().zip(&self.goes).filter(|(_, goes)| **goes);
        // What has no end is everywhere.
        let are_small = changing().all(|(object, _)| object.body.bounds().is_finite());
        if changing().count() > MEMBERS || !are_small || !is_whole {
            self.objects.truncate(count);
            self.goes = goes;
            return None;
        }
        Some(picture)
    }
}

/// What stands in a picture.
pub struct Stand {
    pub scene: Scene,
    /// The members among that, by bits.
    pub present: u128,
    /// Those that are there for this picture alone.
    pub over: u128,
}

/// What changes between two pictures of a cast with these members; `None` if that is not known.
pub fn change(one: (&Scene, u128), other: (&Scene, u128)) -> Option<Ties> {
    let (mut cells, mut last) = (0, None);
    for old in &one.0.objects {
        let found = other.0.objects.iter().position(|new| new.is_same(old));
        let Some(index) = found else { continue };
        // Of surfaces in one place that of the first body is seen: those that stay keep their order.
        if last.replace(index) > Some(index) {
            return None;
        }
        let new = &other.0.objects[index];
        cells |= match (&old.paint, &new.paint) {
            (None, None) => 0,
            (Some(old), Some(new)) => repainted(old, new),
            _ => return None,
        };
    }
    Some(Ties::new(cells, one.1 ^ other.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets::{Assets, SetName};
    use crate::config::{Config, Look};
    use crate::notation::Placement;
    use crate::scene::{Reach, Stage};
    use crate::timeline::{Frame, Gaze, Mover, Spot};
    use shakmaty::{Board, Color, Square};

    fn stage() -> Stage {
        let mut config = Config::new(Look::Thesis);
        config.render.subdivisions = 0;
        let assets = Assets::load(&config, &SetName::Thesis).unwrap();
        Stage::new(&config, &assets, Reach::default()).unwrap()
    }

    fn frame(board: &str) -> Frame {
        Frame::still(Placement::from(&Board::from_ascii_board_fen(board.as_bytes()).unwrap()))
    }

    fn scenes<const N: usize>(stage: &Stage, boards: [&str; N]) -> [Scene; N] {
        boards.map(|board| stage.scene(&frame(board)))
    }

    fn cast(scenes: &[Scene]) -> Cast {
        Cast::new(&scenes[0], scenes[1..].iter().cloned())
    }

    /// A rook goes to the left, back, and farther to the left.
    const BOARDS: [&str; 4] =
        ["8/8/8/8/8/8/8/K6R", "8/8/8/8/8/8/8/K5R1", "8/8/8/8/8/8/8/K6R", "8/8/8/8/8/8/8/K4R2"];

    #[test]
    fn members_are_those_that_come_and_go() {
        let scenes = scenes(&stage(), BOARDS);
        let cast = cast(&scenes);
        assert_eq!([cast.pictures(), cast.members().len()], [4, 3]);
        assert_eq!(cast.present, [0b001, 0b010, 0b001, 0b100]);
        assert_eq!(cast.awaited, [0b111, 0b111, 0b101, 0b100]);
        assert_eq!(cast.fixed.len(), scenes[0].objects.len() - 1);
    }

    #[test]
    fn what_is_there_for_one_picture_alone_does_not_stand() {
        let scenes = scenes(&stage(), BOARDS);
        let mut moving = cast(&scenes);
        for (scene, over) in scenes.iter().zip([0b001, 0b010, 0b001, 0b100]) {
            let stand = moving.stand(scene, 0).unwrap();
            assert_eq!([stand.present, stand.over], [0, over]);
            assert_eq!(stand.scene.objects.len(), scene.objects.len() - 1);
        }
        let twice = [&scenes[0], &scenes[0], &scenes[1]].map(Scene::clone);
        let stand = cast(&twice).stand(&twice[0], 0).unwrap();
        assert_eq!([stand.present, stand.over], [0b01, 0]);
    }

    #[test]
    fn who_sets_out_changes_nothing_yet() {
        let stage = stage();
        let [rests, leaves] = ["7R/8/8/8/8/8/8/K6R", "7R/8/8/8/8/8/8/7R"].map(frame);
        let (piece, square) = (Color::White.king(), Square::A1);
        let mover = Mover { piece, identity: square, spot: Spot::on(square), size: 1.0 };
        let leaves = Frame { movers: vec![mover], ..leaves };
        let [rests, leaves] = [rests, leaves].map(|frame| stage.scene(&frame));
        assert!(change((&rests, 0b1), (&leaves, 0b1)).unwrap().is_empty());
    }

    #[test]
    fn a_picture_is_of_the_cast_until_it_is_past() {
        let scenes = scenes(&stage(), BOARDS);
        let mut cast = cast(&scenes);
        for index in [1, 1, 3] {
            assert!(cast.stand(&scenes[index], 0).is_some());
        }
        assert!(cast.stand(&scenes[1], 0).is_none());
        assert_eq!([0, 1, 2].map(|number| cast.awaits(number)), [false, false, true]);
    }

    #[test]
    fn strangers_are_no_picture_of_the_cast() {
        let stage = stage();
        let boards = [BOARDS[0], BOARDS[1], "8/8/8/8/8/8/8/K6Q", "8/8/8/8/8/8/8/7R"];
        let [one, other, stranger, lacking] = scenes(&stage, boards);
        let gaze = Gaze { orbit: 5.0, ..Gaze::default() };
        let turned = stage.scene(&Frame { gaze, ..frame(BOARDS[1]) });
        let mut cast = cast(&[one.clone(), other, turned.clone(), stranger.clone()]);
        assert_eq!(cast.pictures(), 2);
        for scene in [stranger, turned, lacking] {
            assert!(cast.stand(&scene, 0).is_none());
        }
        assert!(cast.stand(&one, 0).is_some());
    }

    #[test]
    fn a_cast_ends_where_there_is_no_room_for_more() {
        let stage = stage();
        // Each picture has a full rank that was never there.
        let boards = ["pppppppp", "nnnnnnnn", "bbbbbbbb"].into_iter().flat_map(|rank| {
            (0..8).map(move |row| {
                let ranks = (0..8).map(|other| if other == row { rank } else { "8" });
                ranks.collect::<Vec<_>>().join("/")
            })
        });
        let scenes: Vec<Scene> = boards.map(|board| stage.scene(&frame(&board))).collect();
        let cast = cast(&scenes);
        assert_eq!([cast.pictures(), cast.members().len()], [MEMBERS / 8, MEMBERS]);
    }

    #[test]
    fn what_comes_and_what_goes_is_a_change() {
        let [one, other, ..] = scenes(&stage(), BOARDS);
        assert!(change((&one, 0b01), (&one, 0b01)).unwrap().is_empty());
        let moved = change((&one, 0b01), (&other, 0b10)).unwrap();
        assert!([0b01, 0b10].into_iter().all(|member| moved.meet(&Ties::new(0, member))));
        assert!(!moved.meet(&Ties::new(u64::MAX, 0b100)));
    }
}
