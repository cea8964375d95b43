//! Folders, compared file by file.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Files by their paths in a folder.
pub type Tree = BTreeMap<PathBuf, Vec<u8>>;

/// All files below `folder`, hidden ones too.
pub fn tree(folder: &Path) -> Tree {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                found.insert(name, fs::read(path).unwrap());
            }
        }
    }
    found
}

/// Both have the same files with the same bytes, and some at all.
#[allow(dead_code, reason = "not all who read trees compare them so")]
pub fn assert_same(found: &Tree, expected: &Tree, what: &str) {
    assert!(!expected.is_empty(), "{what}");
    let names = |tree: &Tree| tree.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(found), names(expected), "{what}");
    let others: Vec<_> = found.iter().filter(|(name, bytes)| expected[*name] != **bytes).collect();
    let names: Vec<_> = others.into_iter().map(|(name, _)| name).collect();
    assert!(names.is_empty(), "{what}: {names:?} differ");
}
