//! Themes: what the pieces, the board and the ground are made of, under one name.

use std::collections::BTreeMap;

use glam::DVec3;
use serde::Serialize;

use super::Look;
use super::keys::{Key, key};
use super::values::{Choice, ColorOrTransparent, Name, NameOrNone, Optional, YES_NO};

/// What a `[Theme …]` section says, or what `[Board]`, `[Pieces]` and `[GlobalSettings]` say
/// instead of the theme; what is left out is as beneath it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Parts {
    pub light: Option<String>,
    pub dark: Option<String>,
    pub frame: Option<String>,
    pub edge: Option<Edge>,
    pub inlay: Option<Option<String>>,
    pub table: Option<Option<String>>,
    pub coordinates: Option<bool>,
    pub white: Option<String>,
    pub black: Option<String>,
    pub background: Option<Option<DVec3>>,
}

/// What all parts are made of; the names are those of materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Scheme {
    pub light: String,
    pub dark: String,
    pub frame: String,
    pub edge: Edge,
    /// A line let into the frame round the squares, if any.
    pub inlay: Option<String>,
    /// The endless table that the board lies on, if any.
    pub table: Option<String>,
    /// Whether files and ranks are named on the frame.
    pub coordinates: bool,
    pub white: String,
    pub black: String,
    /// What a ray sees that meets nothing, each channel 0 to 1 as it is written to the picture;
    /// `None` where the picture is to be transparent there.
    pub background: Option<DVec3>,
}

/// The shape of the board's frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Edge {
    /// A block a step below the squares, as a first board has it.
    Step,
    /// Four mitred mouldings, flush with the squares.
    Moulded,
}

const EDGES: Choice<Edge> = Choice(&[("step", Edge::Step), ("moulded", Edge::Moulded)]);

/// Where the names of materials stand in a theme.
pub const MATERIAL_KEYS: [&str; 7] = ["Light", "Dark", "Frame", "Inlay", "Table", "White", "Black"];

pub const BOARD_KEYS: [Key<Parts>; 7] = [
    key!("Light", Parts, light: Optional(Name)),
    key!("Dark", Parts, dark: Optional(Name)),
    key!("Frame", Parts, frame: Optional(Name)),
    key!("Edge", Parts, edge: Optional(EDGES)),
    key!("Inlay", Parts, inlay: Optional(NameOrNone)),
    key!("Table", Parts, table: Optional(NameOrNone)),
    key!("Coordinates", Parts, coordinates: Optional(YES_NO)),
];

const OTHER_KEYS: [Key<Parts>; 3] = [
    key!("White", Parts, white: Optional(Name)),
    key!("Black", Parts, black: Optional(Name)),
    key!("BackgroundColor", Parts, background: Optional(ColorOrTransparent)),
];

/// All of them.
pub fn keys() -> Vec<Key<Parts>> {
    BOARD_KEYS.into_iter().chain(OTHER_KEYS).collect()
}

impl Parts {
    /// These parts, and where they leave something out, those of `beneath`.
    pub fn over(&self, beneath: &Parts) -> Parts {
        Parts {
            light: self.light.clone().or(beneath.light.clone()),
            dark: self.dark.clone().or(beneath.dark.clone()),
            frame: self.frame.clone().or(beneath.frame.clone()),
            edge: self.edge.or(beneath.edge),
            inlay: self.inlay.clone().or(beneath.inlay.clone()),
            table: self.table.clone().or(beneath.table.clone()),
            coordinates: self.coordinates.or(beneath.coordinates),
            white: self.white.clone().or(beneath.white.clone()),
            black: self.black.clone().or(beneath.black.clone()),
            background: self.background.or(beneath.background),
        }
    }

    /// All parts; those that nobody names are the thesis's.
    pub fn scheme(self) -> Scheme {
        let name = |given: Option<String>, thesis: &str| given.unwrap_or(thesis.to_owned());
        Scheme {
            light: name(self.light, "light"),
            dark: name(self.dark, "dark"),
            frame: name(self.frame, "frame"),
            edge: self.edge.unwrap_or(Edge::Step),
            inlay: self.inlay.unwrap_or_default(),
            table: self.table.unwrap_or_default(),
            coordinates: self.coordinates.unwrap_or_default(),
            white: name(self.white, "white"),
            black: name(self.black, "black"),
            background: self.background.unwrap_or(Some(DVec3::ZERO)),
        }
    }

    /// The materials that are named, each with its key.
    pub fn materials(&self) -> impl Iterator<Item = (&'static str, &String)> {
        let Parts { light, dark, frame, inlay, table, white, black, .. } = self;
        let [inlay, table] = [inlay, table].map(|name| name.as_ref().and_then(Option::as_ref));
        let names = [
            light.as_ref(),
            dark.as_ref(),
            frame.as_ref(),
            inlay,
            table,
            white.as_ref(),
            black.as_ref(),
        ];
        MATERIAL_KEYS.into_iter().zip(names).filter_map(|(key, name)| Some((key, name?)))
    }
}

/// What a theme of a new name begins as.
pub const BASE: &str = "wood";

/// The theme of a look.
pub fn default_of(look: Look) -> &'static str {
    match look {
        Look::Thesis => "thesis",
        Look::Studio => "wood",
    }
}

/// The themes that need no section, by name: light and dark squares, frame, inlay, table, white
/// and black pieces, background.
pub fn themes() -> BTreeMap<String, Parts> {
    let grey = DVec3::splat(0.24);
    let marble = [
        "honed-white-marble",
        "honed-black-marble",
        "serpentine",
        "brass",
        "graphite",
        "white-marble",
        "black-marble",
    ];
    let glass =
        ["frosted-glass", "slate-glass", "graphite", "brass", "slate", "glass", "smoked-glass"];
    let thesis = ["light", "dark", "frame", "none", "none", "white", "black"];
    [
        theme("wood", ["maple", "walnut", "frame", "maple", "slate", "boxwood", "ebony"], grey),
        theme("tournament", ["buff", "green", "buff", "green", "slate", "ivory", "jet"], grey),
        theme("marble", marble, grey),
        theme("glass", glass, grey),
        theme("print", ["paper", "mid-grey", "paper", "ink", "none", "chalk", "ink"], DVec3::ONE),
        theme("thesis", thesis, DVec3::ZERO),
    ]
    .into()
}

fn theme(name: &str, materials: [&str; 7], background: DVec3) -> (String, Parts) {
    let [light, dark, frame, inlay, table, white, black] = materials.map(str::to_owned);
    let some = |name: String| Some(Some(name).filter(|name| name != "none"));
    let edge = if name == "thesis" { Edge::Step } else { Edge::Moulded };
    let parts = Parts {
        light: Some(light),
        dark: Some(dark),
        frame: Some(frame),
        edge: Some(edge),
        inlay: some(inlay),
        table: some(table),
        coordinates: Some(matches!(name, "tournament" | "print")),
        white: Some(white),
        black: Some(black),
        background: Some(Some(background)),
    };
    (name.to_owned(), parts)
}
