//! How quick kernels, frames, reuse and encoders are: `cargo bench`.

use std::hint::black_box;
use std::io;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use lightsquare::assets::{Assets, SetName, piece_set};
use lightsquare::config::{self, Axis, Config, Look, Quality};
use lightsquare::geometry::{Normals, Sphere};
use lightsquare::notation::{Board, Placement};
use lightsquare::output::encode_png;
use lightsquare::scene::{Material, Noise, Object, Reach, Scene, Stage, Surface, Texture};
use lightsquare::timeline::Frame;
use lightsquare::tracer::kernels::{Fan, Patch, sequence};
use lightsquare::tracer::{Antialiasing, Tracer, render};

/// Rays, or points, along the side of a square.
const SIDE: usize = 64;

const SIZE: [u32; 2] = [320, 192];

const LOOKS: [(&str, Look, SetName, Antialiasing); 2] = [
    ("thesis", Look::Thesis, SetName::Thesis, Antialiasing::Grid(2)),
    (
        "studio",
        Look::Studio,
        SetName::Staunton,
        Antialiasing::Adaptive { rays: 8, threshold: 0.02 },
    ),
];

const START: &str = "rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR";
const E4: &str = "rnbqkbnr/pppppppp/8/8/4P3/8/PPPP1PPP/RNBQKBNR";

fn nearest(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("nearest");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    for (set, normals) in [(SetName::Thesis, Normals::Flat), (SetName::Staunton, Normals::Smooth)] {
        let pieces = piece_set(&set, 4, normals).unwrap();
        let names = ["pawn", "knight", "bishop", "rook", "queen", "king"];
        for (name, piece) in names.into_iter().zip(pieces.men()) {
            let fan = Fan::new(piece, SIDE);
            group.bench_function(format!("{set} {name}"), |bencher| bencher.iter(|| fan.nearest()));
        }
    }
}

fn textures(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("texture");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    let colors = [DVec3::splat(0.2), DVec3::splat(0.7)];
    let noise = Noise { size: 9.0, octaves: 4 };
    let ball = |texture| {
        let config::Material { finish, coat, .. } = config::Material::default();
        let ball = Sphere { center: DVec3::ZERO, radius: 1.0 };
        Object::standing(ball, Surface::Uniform(Material { finish, coat, texture }))
    };
    let [mut start] = scenes(Look::Studio, &SetName::Staunton, [START]);
    let board = start.objects.swap_remove(0);
    for (name, object, from, width) in [
        ("wood", ball(Texture::Wood { colors, noise, grain: Axis::Y }), DVec3::ZERO, 2.0),
        ("timber", ball(Texture::Timber { colors, ring: 0.2, grain: Axis::Y }), DVec3::ZERO, 2.0),
        ("marble", ball(Texture::Marble { colors, noise }), DVec3::ZERO, 2.0),
        ("board", board, DVec3::new(-2.0, 0.0, -2.0), 32.0),
    ] {
        let patch = Patch::new(&object, from, width, SIDE);
        group.bench_function(name, |bencher| bencher.iter(|| patch.color()));
    }
}

fn sequences(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sequence");
    group.throughput(Throughput::Elements(4096));
    group.bench_function("pair", |bencher| bencher.iter(|| sequence(black_box(4096))));
}

fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(10);
    let [width, height] = SIZE;
    for (name, look, set, mode) in LOOKS {
        let [start, e4] = scenes(look, &set, [START, E4]);
        group.bench_function(format!("{name} whole"), |bencher| {
            bencher.iter(|| render(&start, width, height, mode))
        });
        // Forth and back: each picture is a ply after the one before.
        let mut tracer = Tracer::new(width, height, mode);
        let mut plies = [start, e4].into_iter().cycle();
        let mut picture = || {
            let ply = plies.next().unwrap();
            tracer.picture(&ply, plies.clone().take(2))
        };
        picture();
        group
            .bench_function(format!("{name} reuse of a ply"), |bencher| bencher.iter(&mut picture));
    }
}

fn encoders(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("encode");
    let [width, height] = [1000, 600];
    group.throughput(Throughput::Elements(u64::from(width * height)));
    for (name, look, set, _) in LOOKS {
        let [start] = scenes(look, &set, [START]);
        let (picture, _) = render(&start, width, height, Antialiasing::None);
        group.bench_function(format!("png {name}"), |bencher| {
            bencher.iter(|| encode_png(&picture, &[], None, io::sink()).unwrap())
        });
    }
}

/// Positions in a look, as one film has them.
fn scenes<const N: usize>(look: Look, set: &SetName, boards: [&str; N]) -> [Scene; N] {
    let mut config = Config::new(look);
    Quality::Normal.apply(&mut config.render);
    [config.width, config.height] = SIZE;
    let assets = Assets::load(&config, set).unwrap();
    let stage = Stage::new(&config, &assets, Reach::default()).unwrap();
    boards.map(|board| {
        let board = Board::from_ascii_board_fen(board.as_bytes()).unwrap();
        stage.scene(&Frame::still(Placement::from(&board)))
    })
}

criterion_group!(benches, nearest, textures, sequences, frames, encoders);
criterion_main!(benches);
