//! lightsquare reads chess games, replays them and ray-traces them into numbered pictures and films.
//!
//! # One way for the data
//! ```text
//! PGN text ─ game ─ timeline ─ scene ─ tracer ─ output
//!              │       │          │       │        └ numbered pictures, films, manifests, reports
//!              │       │          │       └ Scene → pixels, by Phong's sum or in the studio's light
//!              │       │          └ Frame → bodies, materials, lights or a room, camera
//!              │       └ what stands, moves or is marked where at time t; the clock, the camera's turn
//!              └ tags, start position, legal moves, variations, comments
//! notation: Placement ⇄ "VA1JB1…"   the seam: the chess side ends in it, the picture side starts
//! ```
//!
//! | module | holds | may use |
//! | --- | --- | --- |
//! | [`text`] | text from outside, fit to be shown | – |
//! | [`notation`] | [`notation::Placement`]: pieces and squares of both players, in the thesis's letters | – |
//! | [`game`] | reading PGN into games, with variations and what comments say; selection | notation, config, text |
//! | [`timeline`] | frames: at time *t* a placement, the movers between squares and beside the board, each piece's identity, marks, clock, the camera's turn | game, notation, config |
//! | [`config`] | `config.ini`, typed and range-checked | – |
//! | [`assets`] | piece sets from TOML (`docs/piece-sets.md`), bitmaps, a font | config, geometry |
//! | [`geometry`] | rays, spans, bounds, transforms, curves, and one file a shape | – |
//! | [`scene`] | materials, textures, lights, camera, board and its marks, clock and pieces; builds a [`scene::Scene`] from a frame | geometry, config, assets, notation, timeline |
//! | `lanes` | eight numbers at once, in AVX2's registers or without them; the same bits in either way | – |
//! | `packet` | rays in packets of eight: how they meet solids, and what they see on surfaces | geometry, scene, config, lanes |
//! | [`tracer`] | rays through a whole scene, shading, antialiasing; a picture in memory, and what can stay of it for the next | geometry, scene, lanes, packet |
//! | [`export`] | a scene as another renderer's text | geometry, scene, assets, config |
//! | [`caption`] | the strip of words on a picture, and the cards before and behind a game | assets, config, notation |
//! | [`output`] | pictures, films, manifests, reports; whole files only | text |
//! | [`job`] | what to render: game → timeline → scene → tracer → output; what is done already; plans, shards and their merging; inspect; diagram; export; estimate; bench | all of the above |
//!
//! The binary (`main`, `cli`, `progress`, `signals`) turns arguments into a typed job, shows how far it is,
//! and sets the exit code; it alone prints. A test holds the imports against this table; what modules' own
//! tests build is none of its business.
//!
//! Where this differs from the first design: the camera's turn and lean are part of the frame, as an
//! angle and a point about the board's middle, so that the timeline needs no geometry; its pose on a
//! path is the settings' own type. What room pieces take, which decides how high they are lifted, is
//! measured by the scene on its solids and told to the timeline ([`timeline::Bodies`]). `export` reads what
//! scenes are made of, and so uses `assets` (bitmaps) and `config` (kinds of mapping and filter) too. What can stay
//! of a picture is known by bodies, not by squares: the tracer is told which pictures are to come, and each pixel
//! knows which of the bodies that come and go in them its rays meet, or would meet. A piece that was captured in
//! crazyhouse keeps its identity in hand and where it is dropped: a new one would change its grain in mid-air. Files of
//! games are read twice, to see what there is and to render it game by game, so that they may be of any length. A game's
//! manifest is written before its pictures, and says of each what it shows (a fingerprint), so that whatever ends a run,
//! the next one knows what can stay. Shards of a plan write pictures alone and remove nothing, so that they need not know of each
//! other; manifests, films and reports come with the merging. Where the program differs
//! from the thesis: light loses a share at each surface of glass, where the thesis has full shadows;
//! total internal reflection throws all back, whatever the material's shares; colours are cut to what
//! can be shown when they are stored, not at each surface.
//!
//! A look ([`config::Look`]) is no more than what all settings are before a file or flag changes them.
//! Which of the tracer's two eyes is used is one of them ([`config::Shading`]): a [`scene::Scene`]
//! with a [`scene::Room`] is seen in its soft light, one without by Phong's sum, the thesis's. Both
//! ask the same solids. Colours of the settings are as pictures store them; for the studio they become
//! linear light when the scene is built.

pub mod assets;
pub mod caption;
pub mod config;
pub mod export;
pub mod game;
pub mod geometry;
pub mod job;
mod lanes;
pub mod notation;
pub mod output;
mod packet;
pub mod scene;
pub mod text;
pub mod timeline;
pub mod tracer;
