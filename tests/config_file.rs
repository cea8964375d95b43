//! The shipped `config.ini` says what the program does without it.

use lightsquare::config::Config;

const SHIPPED: &str = include_str!("../config.ini");

#[test]
fn the_shipped_file_is_the_default() {
    let shipped = Config::parse(SHIPPED).unwrap();
    assert_eq!(shipped.to_ini(), Config::default().to_ini());
}

#[test]
fn every_key_of_the_shipped_file_is_explained() {
    let lines: Vec<&str> = SHIPPED.lines().collect();
    let mut keys = 0;
    for (index, line) in
        lines.iter().enumerate().filter(|(_, line)| line.contains('=') && !line.starts_with(';'))
    {
        // The comment stands over the key, or over the one before it that it is one thing with.
        let above = lines[..index]
            .iter()
            .rev()
            .find(|above| !above.contains('=') || above.starts_with(';'));
        assert!(above.is_some_and(|above| above.starts_with(';')), "{line}");
        keys += 1;
    }
    assert_eq!(keys, 33);
}
