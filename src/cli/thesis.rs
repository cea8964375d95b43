//! The thesis's own command line (Turek 2008, 4.6.3): options with one dash, each with a value.
//!
//! clap would read `-config` as `-c onfig`, so such a line is recognised before clap sees it.

use std::path::{Path, PathBuf};

use anyhow::bail;
use lightsquare::assets::SetName;
use lightsquare::config::{Config, Look, Sampling, nearest};
use lightsquare::job::{DiagramJob, Drawn, PictureSettings, Subject};
use lightsquare::notation::Placement;
use lightsquare::output::PictureFormat;

use super::picture::{config_file, read_config};
use super::values::{rays, threads};
use super::{UsageError, keep_transparency};

const USAGE: &str = "lightsquare -config FILE.ini -output FILE.bmp -AA 0|1|2 -ssrays N -cpu N \
                     -whiteplayer PIECES -blackplayer PIECES";

/// What the options say; each may be left out but the output.
#[derive(Default)]
struct Given {
    config: Option<PathBuf>,
    output: Option<PathBuf>,
    sampling: Option<Sampling>,
    rays: Option<u32>,
    threads: Option<usize>,
    white: String,
    black: String,
}

/// Sets what an option says, or tells what was expected instead.
type Setter = fn(&mut Given, &str) -> Result<(), String>;

const OPTIONS: [(&str, Setter); 7] = [
    ("-config", |given, text| {
        given.config = Some(text.into());
        Ok(())
    }),
    ("-output", |given, text| {
        given.output = Some(text.into());
        match PictureFormat::of(Path::new(text)) {
            Some(_) => Ok(()),
            None => Err("expected a name that ends in .bmp or .png".to_owned()),
        }
    }),
    ("-AA", |given, text| {
        let modes = [("0", Sampling::None), ("1", Sampling::Grid), ("2", Sampling::Adaptive)];
        let mode = modes.into_iter().find(|(word, _)| *word == text).map(|(_, mode)| mode);
        given.sampling = mode;
        mode.map(|_| ()).ok_or("expected 0, 1 or 2".to_owned())
    }),
    ("-ssrays", |given, text| rays(text).map(|rays| given.rays = Some(rays))),
    ("-cpu", |given, text| threads(text).map(|threads| given.threads = Some(threads))),
    ("-whiteplayer", |given, text| {
        given.white = text.to_owned();
        Ok(())
    }),
    ("-blackplayer", |given, text| {
        given.black = text.to_owned();
        Ok(())
    }),
];

/// Whether `arguments`, without the program's name, are such a line: the first of them is one of
/// its options.
pub fn is_meant(arguments: &[String]) -> bool {
    let Some(first) = arguments.first() else {
        return false;
    };
    OPTIONS.iter().any(|(name, _)| name.eq_ignore_ascii_case(first))
}

/// The job that `arguments` ask for: always the thesis's set, look and camera, with the settings of
/// the file over them.
pub fn job(arguments: &[String]) -> anyhow::Result<DiagramJob> {
    let given = read(arguments).map_err(UsageError)?;
    let placement = Placement::parse(&given.white, &given.black)
        .map_err(|error| UsageError(format!("-whiteplayer or -blackplayer: {error}")))?;
    let Some(output) = given.output else {
        bail!(UsageError(format!("-output is missing, expected\n  {USAGE}")));
    };
    let config_file = config_file(given.config.as_deref());
    let mut config = read_config(Config::new(Look::Thesis), config_file.as_deref())?;
    config.render.sampling = given.sampling.unwrap_or(config.render.sampling);
    config.render.rays = given.rays.unwrap_or(config.render.rays);
    keep_transparency("-output", &config, &output)?;
    Ok(DiagramJob {
        subject: Subject::Placement { fen: placement.board_fen(), placement },
        drawn: Drawn::default(),
        output,
        picture: PictureSettings {
            config,
            config_file,
            set: SetName::Thesis,
            threads: given.threads,
        },
        dpi: None,
    })
}

fn read(arguments: &[String]) -> Result<Given, String> {
    let mut given = Given::default();
    let mut seen: Vec<&str> = Vec::new();
    for pair in arguments.chunks(2) {
        let Some((name, set)) =
            OPTIONS.iter().find(|(name, _)| name.eq_ignore_ascii_case(&pair[0]))
        else {
            let names = OPTIONS.iter().map(|(name, _)| *name);
            let meant = nearest(&pair[0], names)
                .map_or(format!("expected\n  {USAGE}"), |near| format!("did you mean {near}?"));
            return Err(format!(
                "there is no option `{}` beside {}, {meant}",
                pair[0], arguments[0]
            ));
        };
        let Some(value) = pair.get(1) else {
            return Err(format!("{name} has no value, expected\n  {USAGE}"));
        };
        if seen.contains(name) {
            return Err(format!("{name} is given a second time"));
        }
        seen.push(name);
        if value.is_empty() && !name.ends_with("player") {
            return Err(format!("{name} is empty, expected\n  {USAGE}"));
        }
        set(&mut given, value).map_err(|expected| format!("{name} is `{value}`, {expected}"))?;
    }
    Ok(given)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn only_its_own_options_make_such_a_line() {
        for line in ["-config a.ini", "-AA 2", "-aa 2", "-output a.bmp"] {
            assert!(is_meant(&words(line)), "{line}");
        }
        for line in ["", "render -c a.ini", "-c a.ini", "--config a.ini", "-q", "-configure x"] {
            assert!(!is_meant(&words(line)), "{line}");
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let cases = [
            ("-output a.bmp -wite KE1", "no option `-wite`"),
            ("-output a.bmp -whitplayer KE1", "did you mean -whiteplayer?"),
            ("-output a.bmp -AA", "-AA has no value"),
            ("-AA 3", "-AA is `3`, expected 0, 1 or 2"),
            ("-ssrays 0", "-ssrays is `0`, expected a whole number from 1 to 32"),
            ("-output a.gif", "-output is `a.gif`, expected a name that ends in .bmp or .png"),
            ("-cpu 1 -CPU 2", "-cpu is given a second time"),
        ];
        for (line, message) in cases {
            let error = read(&words(line)).err().unwrap_or_default();
            assert!(error.contains(message), "{line}: {error}");
        }
    }
}
