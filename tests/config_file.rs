//! The shipped `config.ini` explains what the program does without it.

use lightsquare::config::{Config, Parts};

const SHIPPED: &str = include_str!("../config.ini");

/// A line that is a key as soon as its semicolon is taken off.
fn is_key(line: &str) -> bool {
    line.starts_with(';') && line.contains('=') && !line.starts_with("; ")
}

/// The file with all its keys, and the sections that hold them, in force.
fn in_force() -> String {
    let lines = SHIPPED.lines().map(|line| {
        let is_section = line.starts_with(";[");
        if is_key(line) || is_section { &line[1..] } else { line }
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_shipped_file_changes_nothing() {
    assert_eq!(Config::parse(SHIPPED).unwrap(), Config::default());
}

#[test]
fn its_keys_have_the_values_of_the_default() {
    let config = Config::parse(&in_force()).unwrap();
    // What stands over the theme says the same as the theme.
    assert_eq!(config.scheme(), Config::default().scheme());
    assert_eq!(Config { parts: Parts::default(), ..config }, Config::default());
}

#[test]
fn every_key_is_explained() {
    let lines: Vec<&str> = SHIPPED.lines().collect();
    let mut keys = 0;
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| is_key(line)) {
        // The comment stands over the key, or over the one before it that it is one thing with.
        let above = lines[..index].iter().rev().find(|above| !is_key(above));
        assert!(above.is_some_and(|above| above.starts_with("; ")), "{line}");
        keys += 1;
    }
    assert_eq!(keys, 72);
}

#[test]
fn all_themes_and_materials_are_named() {
    let config = Config::default();
    for name in config.themes.keys().chain(config.materials.keys()) {
        let words = SHIPPED.split(|letter: char| !(letter.is_alphanumeric() || letter == '-'));
        assert!(words.clone().any(|word| word == name), "{name}");
    }
}
