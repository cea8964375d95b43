//! Looks: what all settings are before any file or flag.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{
    Camera, Captions, Captured, Clock, Config, FARTHEST, Filter, Knights, Light, Marks, Normals,
    Orientation, Parts, Pose, Render, Room, Sampling, Shading, ShowClock, View, WithoutTimes,
    shelf, theme,
};

/// How pictures look before any setting: a starting point for all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Look {
    /// Soft light in a room, lacquer, smooth curves.
    #[default]
    Studio,
    /// The thesis's camera and lights, Phong's model, hard shadows, flat normals.
    Thesis,
}

impl Config {
    /// The settings of a look.
    pub fn new(look: Look) -> Config {
        let thesis = thesis();
        let config = match look {
            Look::Thesis => thesis,
            Look::Studio => studio(thesis),
        };
        Config {
            materials: shelf::materials(look),
            theme: theme::default_of(look).to_owned(),
            ..config
        }
    }
}

fn thesis() -> Config {
    let light = |position: [f64; 3], color| Light {
        position: position.into(),
        color: DVec3::splat(color),
        ..Light::default()
    };
    Config {
        width: 1000,
        height: 600,
        snell_index: 1.5,
        lights: vec![light([0.0, 150.0, -50.0], 0.8), light([90.0, 90.0, 20.0], 0.5)],
        room: Room::default(),
        camera: Camera {
            view: View::Thesis,
            orientation: Orientation::White,
            aperture: 0.0,
            focus: DVec3::new(14.0, 0.0, 14.0),
            pose: Pose::default(),
            path: Vec::new(),
        },
        knights: Knights::Kingside,
        captured: Captured::Films,
        render: Render {
            shading: Shading::Phong,
            sampling: Sampling::Grid,
            rays: 2,
            threshold: 0.03,
            max_depth: 5,
            max_distance: FARTHEST,
            subdivisions: 4,
            normals: Normals::Flat,
            filter: Filter::Nearest,
            plain: false,
        },
        theme: String::new(),
        themes: theme::themes(),
        parts: Parts::default(),
        marks: Marks::new(false),
        clock: Clock {
            show: ShowClock::No,
            without_times: WithoutTimes::Moves,
            white: 0,
            black: 0,
            case: "frame".to_owned(),
        },
        captions: Captions::default(),
        models: Vec::new(),
        materials: BTreeMap::new(),
    }
}

/// A warm softbox high on the left, a cool one on the right, and a strip behind the board that
/// draws the edges of dark pieces.
fn studio(thesis: Config) -> Config {
    let softbox = |position: [f64; 3], color: [f64; 3], [width, height]: [f64; 2]| Light {
        position: position.into(),
        color: color.into(),
        width,
        height,
    };
    Config {
        width: 1200,
        height: 800,
        camera: Camera { view: View::White, ..thesis.camera },
        knights: Knights::Left,
        marks: Marks::new(true),
        lights: vec![
            softbox([-26.0, 60.0, -10.0], [1.05, 1.0, 0.93], [18.0, 14.0]),
            softbox([60.0, 36.0, -22.0], [0.165, 0.17, 0.178], [16.0, 16.0]),
            softbox([26.0, 68.0, 44.0], [0.52, 0.51, 0.49], [30.0, 6.0]),
        ],
        render: Render {
            shading: Shading::Studio,
            sampling: Sampling::Adaptive,
            rays: 8,
            threshold: 0.02,
            max_depth: 6,
            normals: Normals::Smooth,
            filter: Filter::Mip,
            ..thesis.render
        },
        ..thesis
    }
}
