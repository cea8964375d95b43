//! Solids in the form that packets ask, each made once.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::geometry;
use crate::packet::solids::Solid;

/// A solid, and the packets' form of it.
type Pair = (Arc<dyn geometry::Solid>, Arc<Solid>);

/// Keeps the packets' form of solids that scenes share, from picture to picture.
#[derive(Default)]
pub struct Shelf {
    /// By address; the solid itself is kept so that nothing else can get it.
    made: Mutex<HashMap<usize, Pair>>,
}

/// More solids than a game has are those of pictures past.
const MOST: usize = 256;

impl Shelf {
    /// The packets' form of `solid`.
    pub fn solid(&self, solid: &Arc<dyn geometry::Solid>) -> Arc<Solid> {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if made.len() > MOST {
            made.clear();
        }
        let address = Arc::as_ptr(solid).cast::<()>() as usize;
        let make = || (solid.clone(), Arc::new(Solid::new(&**solid)));
        made.entry(address).or_insert_with(make).1.clone()
    }
}
