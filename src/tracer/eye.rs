//! What looks through places of a picture.

use super::RayCounts;
use super::ties::Ties;

/// An eye: what a sample shows depends on the sample alone.
pub trait Eye<Samples: ?Sized, Seen>: Sync {
    /// Appends what is seen through each of `samples`, in their order, and if it is asked for what that
    /// depends on.
    fn see(
        &self,
        samples: &Samples,
        seen: &mut Vec<Seen>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts;
}
