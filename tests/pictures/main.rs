//! Pictures, beside those of another renderer and beside those of yesterday.

mod agreement;
mod golden;

use std::path::Path;

use assert_cmd::Command;
use image::{DynamicImage, Rgb, RgbImage};

/// The command, in a folder of its own.
pub fn lightsquare(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("lightsquare").unwrap();
    command.current_dir(folder);
    command
}

/// A picture; what is transparent shows a ground of a colour that nothing else has.
pub fn read(path: &Path) -> RgbImage {
    let picture = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let DynamicImage::ImageRgba8(picture) = picture else {
        return picture.to_rgb8();
    };
    RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        let [red, green, blue, alpha] = picture.get_pixel(x, y).0.map(f64::from);
        let over = |color: f64, ground: f64| {
            (color * alpha / 255.0 + ground * (1.0 - alpha / 255.0)).round() as u8
        };
        Rgb([over(red, 255.0), over(green, 0.0), over(blue, 255.0)])
    })
}

/// A picture without any symmetry: an F on coloured squares.
pub fn letter() -> RgbImage {
    RgbImage::from_fn(48, 32, |x, y| {
        let is_stroke = (8..12).contains(&x) && (4..28).contains(&y)
            || (8..24).contains(&x) && (4..8).contains(&y)
            || (8..20).contains(&x) && (14..18).contains(&y);
        let square = if (x / 8 + y / 8) % 2 == 0 { 60 } else { 160 };
        if is_stroke { Rgb([255, 255, 230]) } else { Rgb([5 * x as u8, 7 * y as u8, square]) }
    })
}

/// How far two pictures of one size are apart, pixel by pixel: the largest channel's difference.
pub fn difference(a: &RgbImage, b: &RgbImage) -> Vec<u8> {
    assert_eq!(a.dimensions(), b.dimensions());
    let largest = |(a, b): (&Rgb<u8>, &Rgb<u8>)| {
        a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
    };
    a.pixels().zip(b.pixels()).map(largest).collect()
}

/// Settings that show the clock.
pub const CLOCK: &str = "\
[Clock]
Show=yes
White=1:10:36
Black=10:08:00
[Board]
Table=walnut
[Camera]
Position=34,14,2
LookAt=-6,1,14
FOV=60
";

/// Settings that lay the picture `letter.bmp` on bodies in every way.
pub const MAPPED: &str = "\
[GlobalSettings]
BackgroundColor=0.1,0.2,0.3
[Camera]
Position=14,16,-22
LookAt=14,3,10
FOV=80
ZRot=10
[Model0]
Shape=sphere
Material=globe
Center=4,5,8
Radius=5
[Model1]
Shape=box
Material=tin
Min=11,0.01,6
Max=17,9,10
Rotation=0,30,0
[Model2]
Shape=sphere
Material=jar
Center=24,5,8
Radius=5
[Model3]
Shape=plane
Origin=0,-8,0
Normal=0.1,1,-0.05
Material=tiles
[Material globe]
Texture=bitmap
Bitmap=letter.bmp
Mapping=spherical
Origin=4,5,8
U=0,0,1
V=0.2,1,0
[Material jar]
Texture=bitmap
Bitmap=letter.bmp
Mapping=cylindrical
Origin=24,0,8
U=0.5,0,1
V=0,10,0
[Material tin]
Texture=bitmap
Bitmap=letter.bmp
Origin=14,1,8
U=3,0,0.5
V=0.5,2.5,0
[Material tiles]
Texture=chequer
Color=0.9,0.2,0.1
Color2=0.9,0.9,0.9
Size=3.3
Origin=0.7,0,0.3
Reflectivity=0.3
";
