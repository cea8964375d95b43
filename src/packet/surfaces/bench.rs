use super::*;
use crate::assets::{Assets, SetName};
use crate::config::{self, Config};
use crate::geometry::Solid;
use crate::lanes::{Task, dispatch};
use crate::notation::Placement;
use crate::scene::{Object, Reach, Stage};
use crate::timeline::Frame;
use glam::DVec3;
use std::time::Instant;

struct Many<'a>(&'a Surface, &'a [([DVec3; 8], f32)]);
impl Task for Many<'_> {
    type Output = f32;
    #[inline(always)]
    fn run<S: Simd>(self) -> f32 {
        let mut sum = F32x8::<S>::splat(0.0);
        let q: Vec<_> =
            self.1.iter().map(|(p, s)| (Vec3x8::<S>::load(p), F32x8::splat(*s))).collect();
        let start = Instant::now();
        let mut n = 0;
        while start.elapsed().as_secs_f64() < 0.15 {
            for (p, s) in &q {
                let look = self.0.look(*p, *s, Mask8::all_lanes());
                sum += look.color.x + look.material.i32_to_f32();
            }
            n += q.len();
        }
        std::hint::black_box(sum.store());
        (n as f64 * 8.0 / start.elapsed().as_secs_f64() / 1e6) as f32
    }
}

fn objects(look: config::Look, theme: &str) -> Vec<Object> {
    let mut config = Config::new(look);
    config.theme = theme.to_owned();
    config.render.subdivisions = 1;
    let assets = Assets::load(&config, &SetName::Staunton).unwrap();
    let stage = Stage::new(&config, &assets, Reach::default()).unwrap();
    stage
        .scene(&Frame::still(
            Placement::from_fen("rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR").unwrap(),
        ))
        .objects
}

fn packets(around: DVec3, size: DVec3, step: DVec3, seen: f32) -> Vec<([DVec3; 8], f32)> {
    (0..2048)
        .map(|i| {
            let h = |k: u64| (crate::scene::noise::hash(i, k) >> 11) as f64 / (1_u64 << 53) as f64;
            let first = around + size * (DVec3::new(h(1), h(2), h(3)) - 0.5);
            let p = std::array::from_fn(|l| {
                first + step * DVec3::new((l % 4) as f64, ((l % 4) as f64) * 0.5, (l / 4) as f64)
            });
            (p, seen)
        })
        .collect()
}

#[test]
#[ignore]
fn bench() {
    let wood = objects(config::Look::Studio, "wood");
    for o in &wood {
        if o.seed == 0 {
            println!(
                "{:?}",
                o.surface
                    .materials()
                    .iter()
                    .map(|m| format!("{:?}", m.texture).chars().take(20).collect::<String>())
                    .collect::<Vec<_>>()
            );
        }
    }
    let piece = wood.iter().find(|o| o.seed != 0).unwrap();
    let thesis = objects(config::Look::Thesis, "thesis");
    let marble = objects(config::Look::Studio, "marble");
    let mpiece = marble.iter().find(|o| o.seed != 0).unwrap();
    println!(
        "piece bounds {:?} {}",
        piece.body.solid().bounds(),
        format!("{:?}", mpiece.surface).chars().take(200).collect::<String>()
    );
    let sq = DVec3::new(4.0, -1e-4, 8.0);
    let flat = DVec3::new(3.0, 0.0, 3.0);
    let all = DVec3::new(31.0, 0.0, 31.0);
    let px = DVec3::new(0.04, 0.0, 0.06);
    let cases: Vec<(&str, &Object, Vec<([DVec3; 8], f32)>)> = vec![
        ("square, rings and fibres", &wood[0], packets(sq, flat, px * 0.5, 0.02)),
        ("square, all at 0.04", &wood[0], packets(sq, flat, px, 0.04)),
        ("square, rings", &wood[0], packets(sq, flat, px, 0.06)),
        ("square, far", &wood[0], packets(sq, flat, px * 4.0, 0.3)),
        ("board at 0.04", &wood[0], packets(DVec3::new(14.0, -1e-4, 14.0), all, px, 0.04)),
        ("frame, lettered", &wood[0], packets(DVec3::new(14.0, -1e-4, -3.0), DVec3::new(31.0, 0.0, 1.6), px, 0.04)),
        ("table", &wood[1], packets(DVec3::new(14.0, -1.6, -8.0), DVec3::new(31.0, 0.0, 8.0), px, 0.04)),
        ("boxwood piece", piece, packets(DVec3::new(1.0, 2.0, 0.5), DVec3::new(0.5, 3.0, 0.5), DVec3::new(0.04, 0.02, 0.04), 0.04)),
        ("boxwood near", piece, packets(DVec3::new(1.0, 2.0, 0.5), DVec3::new(0.5, 3.0, 0.5), DVec3::new(0.02, 0.01, 0.02), 0.02)),
        ("thesis frame", thesis.iter().find(|o| matches!(&o.surface, scene::Surface::Uniform(m) if matches!(m.texture, scene::Texture::Wood{..}))).unwrap(), packets(DVec3::new(14.0, -0.1, -3.0), DVec3::new(31.0, 0.0, 1.6), px, 0.04)),
        ("thesis squares", &thesis[0], packets(sq, flat, px, 0.04)),
        ("marble piece", mpiece, packets(DVec3::new(1.0, 2.0, 0.5), DVec3::new(0.5, 3.0, 0.5), DVec3::new(0.04, 0.02, 0.04), 0.04)),
        ("marble square", &marble[0], packets(sq, flat, px, 0.04)),
        ("plain", thesis.last().unwrap(), packets(sq, flat, px, 0.04)),
    ];
    for (name, object, packets) in &cases {
        let surface = Surface::new(object);
        let mut rates: Vec<f32> = (0..7).map(|_| dispatch(Many(&surface, packets))).collect();
        rates.sort_by(f32::total_cmp);
        println!("{name:26} {:8.1} M/s  (best {:.1})", rates[3], rates[6]);
    }
}
