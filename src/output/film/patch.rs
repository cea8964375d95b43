//! What of a picture is other than in the one before.

use image::{DynamicImage, Rgba, RgbaImage};

/// A rectangle of pixels: left, top, width and height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    pub left: u32,
    pub top: u32,
    pub width: u32,
    pub height: u32,
}

impl Patch {
    /// The first pixel alone.
    pub const PIXEL: Patch = Patch { left: 0, top: 0, width: 1, height: 1 };

    /// All of a picture.
    pub fn whole([width, height]: [u32; 2]) -> Patch {
        Patch { left: 0, top: 0, width, height }
    }

    /// The smallest one that holds all pixels in which the two pictures, of one size and kind, differ; a single pixel
    /// where none does.
    pub fn between(before: &DynamicImage, after: &DynamicImage) -> Patch {
        let (width, channels) =
            (after.width() as usize, usize::from(after.color().channel_count()));
        let [mut left, mut right, mut top, mut bottom] = [usize::MAX, 0, usize::MAX, 0];
        let pitch = width * channels;
        let rows = before.as_bytes().chunks_exact(pitch).zip(after.as_bytes().chunks_exact(pitch));
        for (y, (before, after)) in rows.enumerate().filter(|(_, (before, after))| before != after)
        {
            let differs = |index: &usize| before[*index] != after[*index];
            let first = (0..pitch).find(differs).unwrap_or(0) / channels;
            let last = (0..pitch).rev().find(differs).unwrap_or(0) / channels;
            (left, right) = (left.min(first), right.max(last + 1));
            (top, bottom) = (top.min(y), y + 1);
        }
        if bottom == 0 {
            return Patch::PIXEL;
        }
        Patch {
            left: left as u32,
            top: top as u32,
            width: (right - left) as u32,
            height: (bottom - top) as u32,
        }
    }

    /// What it holds of a picture.
    pub fn of(&self, picture: &DynamicImage) -> RgbaImage {
        picture.crop_imm(self.left, self.top, self.width, self.height).to_rgba8()
    }

    /// The same, where it is as `before` transparent.
    pub fn change(&self, before: &DynamicImage, picture: &DynamicImage) -> RgbaImage {
        let mut change = self.of(picture);
        let (was, channels) = (before.as_bytes(), usize::from(before.color().channel_count()));
        let row = |y: u32| {
            let start = (self.top + y) as usize * before.width() as usize + self.left as usize;
            was[channels * start..].chunks_exact(channels)
        };
        for (y, pixels) in (0..).zip(change.rows_mut()) {
            for (pixel, was) in pixels.zip(row(y)) {
                if pixel.0[..channels] == *was {
                    *pixel = Rgba([0; 4]);
                }
            }
        }
        change
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    fn picture(dots: &[[u32; 2]]) -> DynamicImage {
        let mut picture = RgbImage::from_pixel(9, 7, Rgb([5, 6, 7]));
        dots.iter().for_each(|[x, y]| picture.put_pixel(*x, *y, Rgb([5, 6, 8])));
        picture.into()
    }

    #[test]
    fn a_patch_holds_all_that_differs_and_no_more() {
        let patch = |dots: &[[u32; 2]]| {
            let Patch { left, top, width, height } = Patch::between(&picture(&[]), &picture(dots));
            [left, top, width, height]
        };
        assert_eq!(patch(&[]), [0, 0, 1, 1]);
        assert_eq!(patch(&[[8, 6]]), [8, 6, 1, 1]);
        assert_eq!(patch(&[[2, 5], [4, 1]]), [2, 1, 3, 5]);
        assert_eq!(patch(&[[0, 0], [8, 6]]), [0, 0, 9, 7]);
    }

    #[test]
    fn a_change_is_transparent_where_nothing_changed() {
        let (before, after) = (picture(&[]), picture(&[[2, 5], [4, 1]]));
        let change = Patch::between(&before, &after).change(&before, &after);
        let seen: Vec<_> = change.enumerate_pixels().filter(|(_, _, pixel)| pixel[3] > 0).collect();
        assert_eq!(seen, [(2, 0, &Rgba([5, 6, 8, 255])), (0, 4, &Rgba([5, 6, 8, 255]))]);
    }
}
