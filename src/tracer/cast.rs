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

/// All bodies of a row of pictures.
pub struct Cast {
    first: Scene,
    /// 1, but in a test.
    share: f64,
    /// Those that are in all of the pictures; any other is a member.
    fixed: Vec<Object>,
    members: Vec<Object>,
    /// How many pictures there are.
    pub pictures: usize,
}

/// No more pictures than these are looked at.
const FARTHEST: usize = 512;

impl Cast {
    /// The cast of `scene` and of as many of those after it as it has room for.
    pub fn new(scene: &Scene, coming: impl Iterator<Item = Scene>) -> Cast {
        let mut cast = Cast {
            first: scene.clone(),
            share: 1.0,
            fixed: scene.objects.clone(),
            members: Vec::new(),
            pictures: 1,
        };
        for scene in coming.take(FARTHEST) {
            if !cast.admits(&scene) {
                break;
            }
            cast.pictures += 1;
        }
        cast
    }

    /// Makes room for those bodies of `scene` that come, and those that go; whether there is any.
    fn admits(&mut self, scene: &Scene) -> bool {
        if !is_alike(&self.first, scene) {
            return false;
        }
        let is_there = |object: &Object| scene.objects.iter().any(|other| other.is_same(object));
        let goes = |object: &&Object| !is_there(object);
        let comes = |object: &&Object| {
            let is_known = |known: &Object| known.is_same(object);
            !self.fixed.iter().any(is_known) && !self.members.iter().any(is_known)
        };
        let gone = self.fixed.iter().filter(goes);
        let others: Vec<Object> = gone.chain(scene.objects.iter().filter(comes)).cloned().collect();
        let has_room = self.members.len() + others.len() <= MEMBERS;
        // What has no end is everywhere.
        if !has_room || others.iter().any(|other| !other.body.bounds().is_finite()) {
            return false;
        }
        self.fixed.retain(|object| is_there(object));
        self.members.extend(others);
        true
    }

    /// For a test: the same, with smaller envelopes.
    pub fn shrunk(self, share: f64) -> Cast {
        Cast { share, ..self }
    }

    pub fn members(&self) -> &[Object] {
        &self.members
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

    /// What stands in `scene`: what is fixed, and members that were there `before` or are in the `next` picture;
    /// `None` if it is no picture of this cast.
    pub fn stand(&self, scene: &Scene, before: u128, next: Option<&Scene>) -> Option<Stand> {
        let all = self.present(scene)?;
        let stay = before | next.and_then(|next| self.present(next)).unwrap_or(0);
        let (present, over) = (all & stay, all & !stay);
        let stands =
            |object: &&Object| self.number(object).is_none_or(|number| present >> number & 1 == 1);
        let objects = scene.objects.iter().filter(stands).cloned().collect();
        Some(Stand { scene: Scene { objects, ..scene.clone() }, present, over })
    }

    /// The members that are in `scene`; `None` if it is no picture of this cast.
    fn present(&self, scene: &Scene) -> Option<u128> {
        if !is_alike(&self.first, scene) {
            return None;
        }
        let (mut present, mut fixed) = (0, 0);
        for object in &scene.objects {
            match self.number(object) {
                Some(number) => present |= 1 << number,
                None if self.fixed.iter().any(|known| known.is_same(object)) => fixed += 1,
                None => return None,
            }
        }
        (fixed == self.fixed.len()).then_some(present)
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
    let mut cells = 0;
    for old in &one.0.objects {
        let Some(new) = other.0.objects.iter().find(|new| new.is_same(old)) else { continue };
        cells |= match (&old.paint, &new.paint) {
            (None, None) => 0,
            (Some(old), Some(new)) => repainted(old, new),
            _ => return None,
        };
    }
    Some(Ties::new(cells, one.1 ^ other.1))
}
