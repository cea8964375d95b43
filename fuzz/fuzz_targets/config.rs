//! Any text as settings: what is accepted comes back the same from what is printed of it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightsquare::config::Config;

fuzz_target!(|text: &str| {
    if let Ok(config) = Config::parse(text) {
        let printed = config.to_ini();
        assert_eq!(Config::parse(&printed).ok(), Some(config), "{printed}");
    }
});
