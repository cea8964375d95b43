//! Any text as the pawn of a set whose other files are right: it is refused with a sentence, or gives a piece.
#![no_main]

use std::fs;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::Config;
use tempfile::TempDir;

/// The set of the program, as files.
static SET: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = TempDir::new().expect("a temporary folder");
    let built_in = concat!(env!("CARGO_MANIFEST_DIR"), "/../src/assets/sets/staunton");
    for entry in fs::read_dir(built_in).expect("the set's folder").flatten() {
        fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("a copy");
    }
    folder
});

fuzz_target!(|text: &str| {
    fs::write(SET.path().join("pawn.toml"), text).expect("the pawn's file");
    let set = SetName::Folder(SET.path().to_owned());
    if let Err(error) = Assets::load(&Config::default(), &set) {
        assert!(!error.to_string().is_empty());
    }
});
