//! The imports between modules, held against the table in `src/lib.rs`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What each module may use, as the table says.
fn allowed() -> BTreeMap<String, BTreeSet<String>> {
    let table = include_str!("../src/lib.rs");
    let rows: Vec<(String, String)> = table
        .lines()
        .filter_map(|line| {
            let mut cells = line.strip_prefix("//! | ")?.split('|');
            // What is not public cannot be linked.
            let name = cells.next()?.trim().trim_start_matches('[').trim_end_matches(']');
            let module = name.strip_prefix('`')?.strip_suffix('`')?.to_owned();
            Some((module, cells.nth(1)?.trim().to_owned()))
        })
        .collect();
    let names: Vec<String> = rows.iter().map(|(module, _)| module.clone()).collect();
    rows.into_iter()
        .map(|(module, uses)| {
            let uses = match uses.as_str() {
                "–" => BTreeSet::new(),
                "all of the above" => names.iter().cloned().collect(),
                list => list.split(", ").map(str::to_owned).collect(),
            };
            (module, uses)
        })
        .collect()
}

/// Module and code of every source file of the library, without its tests.
fn sources(folder: &Path, module: Option<&str>, found: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        let module = module.map_or_else(|| stem.clone(), str::to_owned);
        if path.is_dir() {
            sources(&path, Some(&module), found);
        } else if path.extension().is_some_and(|ending| ending == "rs") && stem != "tests" {
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
            found.push((module, code.to_owned()));
        }
    }
}

#[test]
fn modules_use_only_what_the_table_allows() {
    let allowed = allowed();
    assert!(allowed.len() >= 10, "the table is not found: {allowed:?}");
    let mut files = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), None, &mut files);
    let mut checked = 0;
    for (module, text) in files {
        let Some(allowed) = allowed.get(&module) else {
            assert!(
                ["lib", "main", "cli", "progress", "signals"].contains(&module.as_str()),
                "{module}"
            );
            continue;
        };
        for (_, after) in
            text.match_indices("crate::").map(|(at, found)| (at, &text[at + found.len()..]))
        {
            let used: String =
                after.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            assert!(used == module || allowed.contains(&used), "{module} uses {used}");
            checked += 1;
        }
        let knows_chess = ["notation", "game", "timeline"].contains(&module.as_str());
        assert!(knows_chess || !text.contains("shakmaty"), "{module} knows shakmaty");
    }
    assert!(checked > 20, "{checked}");
}
