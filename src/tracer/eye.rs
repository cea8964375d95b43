//! What looks through places of a picture.

use super::RayCounts;
use super::regions::Regions;

/// An eye: what a sample shows depends on the sample alone.
pub trait Eye: Sync {
    /// Where a ray goes through the picture.
    type Sample: Copy + Send + Sync;
    /// What comes back along it.
    type Seen: Copy + Default + Send + Sync;

    /// Appends what is seen through each of `samples`, in their order, and if it is asked for which regions
    /// that depends on.
    fn see(
        &self,
        samples: &[Self::Sample],
        seen: &mut Vec<Self::Seen>,
        touched: Option<&mut Vec<Regions>>,
    ) -> RayCounts;
}
