//! Films in one file, as the command makes them: read again, and held against the numbered pictures.

use std::collections::BTreeMap;
use std::fs;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use gif::{ColorOutput, DecodeOptions};
use image::{Rgba, RgbaImage};
use serde_json::Value;
use tempfile::TempDir;

const GAME: &str = "[White \"Anand\"]\n[Black \"Topalov\"]\n[Result \"1-0\"]\n\n\
    1. e4 d5 2. exd5 Qxd5 3. Nc3 1-0\n";

const FOLDER: &str = "out/game/0001-anand-topalov";

/// Small pictures, quickly made.
const PLAIN: [&str; 4] = ["--look", "thesis", "--aa", "none"];
const TINY: [&str; 2] = ["--size", "48x32"];

/// A second and a half at the ends, and so a film of 4.5 s.
const TIMES: [&str; 9] =
    ["--animate", "--transition", "0.3", "--pause", "0.375", "--first", "0.5", "--last", "1"];

/// Runs the command in `folder` with its game: exit code and messages. No other program is there but what `path` has.
fn run(folder: &Path, path: &str, parts: &[&[&str]]) -> (i32, String) {
    fs::write(folder.join("game.pgn"), GAME).unwrap();
    let mut command = Command::cargo_bin("lightsquare").unwrap();
    command.current_dir(folder).env("PATH", path).args(["render", "game.pgn"]).args(PLAIN);
    if !parts.concat().contains(&"--size") {
        command.args(TINY);
    }
    parts.iter().for_each(|part| {
        command.args(*part);
    });
    let output = command.output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

fn done(folder: &Path, parts: &[&[&str]]) {
    assert_eq!(run(folder, "", parts).0, 0, "{:?}", run(folder, "", parts));
}

/// A film and its pictures, with the words of titles, clocks and captions between them.
const WORDS: [&str; 8] =
    ["--size", "128x96", "--captions", "--clock", "--title=0.5", "--result=0.5", "--fps", "10"];

/// The files in the game's folder by name; none if there is no such folder.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let Ok(entries) = fs::read_dir(folder.join(FOLDER)) else {
        return BTreeMap::new();
    };
    let read = |path: PathBuf| fs::read(path).unwrap();
    entries
        .map(|entry| entry.unwrap())
        .map(|entry| (entry.file_name().into_string().unwrap(), read(entry.path())))
        .collect()
}

fn names(folder: &Path) -> Vec<String> {
    files(folder).into_keys().collect()
}

fn manifest(folder: &Path) -> Value {
    serde_json::from_slice(&files(folder)["game.json"]).unwrap()
}

/// The numbered pictures.
fn pictures(folder: &Path) -> Vec<RgbaImage> {
    let files = files(folder);
    let frames = files.iter().filter(|(name, _)| name.starts_with("frame_"));
    frames.map(|(_, bytes)| image::load_from_memory(bytes).unwrap().to_rgba8()).collect()
}

/// Pictures as they are shown, each with its time in steps.
type Shown = Vec<(RgbaImage, u64)>;

/// Lays what is not transparent of a patch over a picture.
fn lay(picture: &mut RgbaImage, [left, top, width]: [u32; 3], pixels: &[u8]) {
    for (index, pixel) in (0..).zip(pixels.chunks_exact(4)) {
        if pixel[3] > 0 {
            let pixel = Rgba([pixel[0], pixel[1], pixel[2], pixel[3]]);
            picture.put_pixel(left + index % width, top + index / width, pixel);
        }
    }
}

fn gif(bytes: &[u8]) -> Shown {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).unwrap();
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    let mut picture = RgbaImage::new(decoder.width().into(), decoder.height().into());
    let mut shown = Shown::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let place = [frame.left, frame.top, frame.width].map(u32::from);
        lay(&mut picture, place, &frame.buffer);
        shown.push((picture.clone(), frame.delay.into()));
        if frame.dispose == gif::DisposalMethod::Background {
            picture.fill(0);
        }
    }
    shown
}

fn apng(bytes: &[u8]) -> Shown {
    let mut reader =
        png::Decoder::new(BufReader::new(std::io::Cursor::new(bytes))).read_info().unwrap();
    let control = reader.info().animation_control().copied().unwrap();
    assert_eq!(control.num_plays, 0);
    let mut picture = RgbaImage::new(reader.info().width, reader.info().height);
    let mut shown = Shown::new();
    for _ in 0..control.num_frames {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let frame = *reader.info().frame_control().unwrap();
        pixels.truncate((frame.width * frame.height * 4) as usize);
        if frame.blend_op == png::BlendOp::Source {
            let columns = frame.x_offset..frame.x_offset + frame.width;
            let rows = frame.y_offset..frame.y_offset + frame.height;
            for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
                picture.put_pixel(x, y, Rgba([0; 4]));
            }
        }
        lay(&mut picture, [frame.x_offset, frame.y_offset, frame.width], &pixels);
        assert_eq!(frame.delay_den, 1000);
        shown.push((picture.clone(), frame.delay_num.into()));
    }
    shown
}

/// What is shown at a `time` in steps.
fn at(shown: &Shown, time: f64) -> &RgbaImage {
    let mut end = 0;
    let found = shown.iter().find(|(_, steps)| {
        end += steps;
        time < end as f64
    });
    &found.unwrap().0
}

/// The mean difference of all channels, in steps of 255.
fn difference(one: &RgbaImage, other: &RgbaImage) -> f64 {
    let sum: u64 = one.iter().zip(other.iter()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / one.len() as f64
}

#[test]
fn films_show_what_the_pictures_show_for_as_long() {
    let folder = TempDir::new().unwrap();
    for fps in [10_usize, 24, 30, 50] {
        let rate = fps.to_string();
        done(folder.path(), &[&TIMES, &["--fps", &rate, "--film", "gif", "--film", "apng"]]);
        let (files, pictures) = (files(folder.path()), pictures(folder.path()));
        assert_eq!(pictures.len(), 45 * fps / 10, "{fps}");
        let (gif, apng) = (gif(&files["film.gif"]), apng(&files["film.apng"]));
        let total = |shown: &Shown| shown.iter().map(|(_, steps)| *steps).sum::<u64>();
        assert_eq!([total(&gif), total(&apng)], [450, 4500], "{fps}");
        for (index, picture) in pictures.iter().enumerate() {
            // In the middle of its time, whatever that is rounded to.
            let time = (index as f64 + 0.5) / fps as f64;
            assert_eq!(at(&apng, 1000.0 * time), picture, "{fps}: {index}");
            let difference = difference(at(&gif, 100.0 * time), picture);
            assert!(difference < 2.5, "{fps}: {index}: {difference}");
        }
    }
}

/// What is shown is a new picture only where the studio made one; and opaque titles stand among transparent pictures.
#[test]
fn films_show_words_and_what_is_transparent() {
    let folder = TempDir::new().unwrap();
    for transparent in [&[][..], &["--transparent"]] {
        let films = ["--film", "gif", "--film", "apng"];
        done(folder.path(), &[&TIMES, &WORDS, &films, transparent]);
        let (files, pictures) = (files(folder.path()), pictures(folder.path()));
        assert_eq!(pictures.len(), 55);
        let (gif, apng) = (gif(&files["film.gif"]), apng(&files["film.apng"]));
        for (index, picture) in pictures.iter().enumerate() {
            let found = at(&apng, 100.0 * (index as f64 + 0.5));
            assert!(found == picture, "{transparent:?}: {index}");
            let rough = at(&gif, 10.0 * (index as f64 + 0.5));
            let solid = |picture: &RgbaImage| {
                picture.pixels().map(|pixel| pixel[3] > 127).collect::<Vec<_>>()
            };
            assert!(solid(rough) == solid(picture), "{transparent:?}: {index}");
        }
    }
}

/// One that is whole from its beginning to its end, as libwebp reads it.
#[cfg(feature = "webp")]
#[test]
fn a_webp_is_as_long_as_it_should_be() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[&TIMES, &["--film", "webp", "--no-frames", "--fps", "20"]]);
    let bytes = files(folder.path()).remove("film.webp").unwrap();
    let decoder = webp_animation::Decoder::new(&bytes).unwrap();
    let frames: Vec<_> = decoder.into_iter().collect();
    assert_eq!(frames[0].dimensions(), (48, 32));
    assert!((30..=36).contains(&frames.len()), "{}", frames.len());
    // Each says when it ends.
    assert_eq!(frames.last().unwrap().timestamp(), 4500);
}

#[test]
fn places_have_their_sizes_and_their_formats() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("game.pgn"), GAME).unwrap();
    for (place, size, film, captured) in [
        ("square", "1080x1080", "mp4", "films"),
        ("wide", "1920x1080", "mp4", "films"),
        ("tall", "1080x1920", "mp4", "gone"),
        ("gif", "480x480", "gif", "gone"),
    ] {
        let mut command = Command::cargo_bin("lightsquare").unwrap();
        command.current_dir(folder.path()).args(["render", "--for", place, "--print-config"]);
        let said = String::from_utf8(command.output().unwrap().stdout).unwrap().to_lowercase();
        let (width, height) = size.split_once('x').unwrap();
        for line in
            [format!("width={width}"), format!("height={height}"), format!("captured={captured}")]
        {
            assert!(said.replace(' ', "").contains(&line), "{place}: {line}: {said}");
        }
        if film == "mp4" && cfg!(not(feature = "h264")) {
            continue;
        }
        let small =
            ["--for", place, "--size", "128x96", "--no-frames", "--last", "0", "--to", "1w"];
        done(folder.path(), &[&small]);
        assert_eq!(names(folder.path()), [format!("film.{film}"), "game.json".to_owned()]);
    }
}

#[test]
fn variations_have_films_of_their_own() {
    let folder = TempDir::new().unwrap();
    let game = "[White \"Anand\"]\n[Black \"Topalov\"]\n\n1. e4 (1. d4 d5) e5 *\n";
    fs::write(folder.path().join("two.pgn"), game).unwrap();
    let mut command = Command::cargo_bin("lightsquare").unwrap();
    let options = ["render", "two.pgn", "--variations", "--film", "gif", "--no-frames", "-q"];
    command.current_dir(folder.path()).args(options).args(TINY).args(PLAIN).assert().success();
    let within = folder.path().join("out/two/0001-anand-topalov");
    for film in ["film.gif", "1w-d4/film.gif"] {
        assert!(!gif(&fs::read(within.join(film)).unwrap()).is_empty(), "{film}");
    }
}

#[test]
fn a_film_of_positions_alone_is_as_long_as_one_with_moves() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[&TIMES[1..], &["--film", "apng", "--no-frames"]]);
    assert_eq!(names(folder.path()), ["film.apng", "game.json"]);
    let film = apng(&files(folder.path())["film.apng"]);
    let times: Vec<u64> = film.iter().map(|(_, steps)| *steps).collect();
    assert_eq!(times, [800, 675, 675, 675, 675, 1000]);
    let manifest = manifest(folder.path());
    assert_eq!(manifest["films"], serde_json::json!(["film.apng"]));
    assert!(manifest["frames"].as_array().unwrap().iter().all(|row| row.get("file").is_none()));
}

#[test]
fn films_are_the_same_bytes_whatever_the_number_of_threads() {
    let films = |threads: &str| {
        let folder = TempDir::new().unwrap();
        let formats =
            ["--film", "gif", "--film", "apng", "--no-frames", "--fps", "12", "--cpu", threads];
        done(folder.path(), &[&TIMES, &formats]);
        let mut files = files(folder.path());
        files.remove("game.json");
        assert_eq!(files.len(), 2);
        files
    };
    assert!(films("1") == films("3"));
}

#[test]
fn a_long_pause_is_more_than_one_frame() {
    let folder = TempDir::new().unwrap();
    let times = ["--first", "1000", "--last", "70", "--pause", "0", "--transition", "0"];
    done(
        folder.path(),
        &[&times, &["--film", "gif", "--film", "apng", "--no-frames", "--to", "1w"]],
    );
    let files = files(folder.path());
    let steps = |shown: Shown| shown.into_iter().map(|(_, steps)| steps).collect::<Vec<_>>();
    assert_eq!(steps(gif(&files["film.gif"])), [65_535, 34_465, 7_000]);
    let apng = steps(apng(&files["film.apng"]));
    assert_eq!((apng.iter().sum::<u64>(), apng.len()), (1_070_000, 18));
}

/// The boxes of an MP4 file, with what they hold.
#[cfg(feature = "h264")]
fn boxes(mut bytes: &[u8]) -> Vec<(String, &[u8])> {
    let mut found = Vec::new();
    while bytes.len() >= 8 {
        let length = u32::from_be_bytes(bytes[..4].try_into().unwrap()) as usize;
        found.push((String::from_utf8_lossy(&bytes[4..8]).into_owned(), &bytes[8..length]));
        bytes = &bytes[length..];
    }
    found
}

/// What a box within boxes holds.
#[cfg(feature = "h264")]
fn inside<'a>(bytes: &'a [u8], path: &[&str]) -> &'a [u8] {
    path.iter().fold(bytes, |bytes, name| {
        boxes(bytes).into_iter().find(|(found, _)| found == name).unwrap().1
    })
}

#[cfg(feature = "h264")]
fn number(bytes: &[u8], index: usize) -> u32 {
    u32::from_be_bytes(bytes[4 * index..4 * index + 4].try_into().unwrap())
}

#[cfg(feature = "h264")]
#[test]
fn an_mp4_is_made_where_there_is_no_ffmpeg() {
    let folder = TempDir::new().unwrap();
    let wide = ["--size", "49x33", "--fps", "30", "--film", "mp4", "--no-frames"];
    fs::write(folder.path().join("game.pgn"), GAME).unwrap();
    let (code, said) = run(folder.path(), "", &[&TIMES, &wide]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("film.mp4: is 48x32 instead of 49x33, its sides are even"), "{said}");
    let film = files(folder.path()).remove("film.mp4").unwrap();
    let order: Vec<String> = boxes(&film).into_iter().map(|(name, _)| name).collect();
    assert_eq!(order, ["ftyp", "moov", "mdat"]);
    let table = inside(&film, &["moov", "trak", "mdia", "minf", "stbl"]);
    // All samples are as long: 135 of 3000 parts of 90,000 of a second.
    let times = inside(table, &["stts"]);
    assert_eq!([1, 2, 3].map(|index| number(times, index)), [1, 135, 3000]);
    let mut decoder = openh264::decoder::Decoder::new().unwrap();
    let sample = &inside(&film, &["mdat"])[..number(inside(table, &["stsz"]), 3) as usize];
    // Each unit has its length before it; the decoder wants a mark instead.
    let (mut stream, mut rest) = (Vec::new(), sample);
    while !rest.is_empty() {
        let length = number(rest, 0) as usize;
        stream.extend([0, 0, 0, 1]);
        stream.extend(&rest[4..4 + length]);
        rest = &rest[4 + length..];
    }
    let picture = decoder.decode(&stream).unwrap().expect("the first picture stands alone");
    use openh264::formats::YUVSource;
    assert_eq!(picture.dimensions(), (48, 32));
}

/// What ffprobe says of a film: codec, width, height, kind of pixels, and the pictures that it could decode.
fn probed(path: &Path) -> Option<String> {
    let entries = "stream=codec_name,width,height,pix_fmt,nb_read_frames,duration";
    let arguments = ["-v", "error", "-count_frames", "-show_entries", entries, "-of", "csv=p=0"];
    let output = std::process::Command::new("ffprobe").args(arguments).arg(path).output().ok()?;
    Some(String::from_utf8(output.stdout).unwrap().trim().to_owned())
}

/// By somebody who wrote none of them.
#[test]
fn ffprobe_reads_films_to_the_last_picture() {
    if probed(Path::new("none")).is_none() {
        eprintln!("skipped: there is no ffprobe");
        return;
    }
    let folder = TempDir::new().unwrap();
    let path = std::env::var("PATH").unwrap();
    let formats =
        ["--film", "gif", "--film", "apng", "--film", "mp4", "--no-frames", "--fps", "20"];
    let probe =
        |ending: &str| probed(&folder.path().join(FOLDER).join(format!("film.{ending}"))).unwrap();
    assert_eq!(run(folder.path(), &path, &[&TIMES, &formats]).0, 0);
    assert_eq!(probe("mp4"), "h264,48,32,yuv420p,4.500000,90");
    let shown = |found: &str, codec: &str| {
        let frames: usize = found.rsplit(',').next().unwrap().parse().unwrap();
        // A picture for each that differs: five moves of six, and a position behind each.
        assert!(found.starts_with(codec) && (30..=36).contains(&frames), "{found}");
    };
    shown(&probe("gif"), "gif,48,32,bgra,4.500000");
    shown(&probe("apng"), "apng,48,32,rgba");
    if cfg!(feature = "h264") {
        assert_eq!(run(folder.path(), "", &[&TIMES, &formats]).0, 0);
        assert_eq!(probe("mp4"), "h264,48,32,yuv420p,4.500000,90");
    }
}

#[test]
fn pictures_have_the_names_and_the_format_that_are_asked_for() {
    let folder = TempDir::new().unwrap();
    for (options, expected) in [
        (&["--format", "jpg"][..], "frame_00003.jpg"),
        (&["--format", "bmp"], "frame_00003.bmp"),
        (&["--names", "move-###.tiff"], "move-003.tiff"),
        (&["--names", "%d", "--format", "webp"], "3.webp"),
        (&[], "frame_00003.png"),
    ] {
        done(folder.path(), &[options]);
        let names = names(folder.path());
        assert!(names.iter().any(|name| name == expected), "{expected}: {names:?}");
        assert_eq!(manifest(folder.path())["frames"][3]["file"], expected);
        let path = folder.path().join(FOLDER).join(expected);
        assert!(image::open(path).is_ok_and(|picture| picture.width() == 48), "{expected}");
    }
}

#[test]
fn films_of_an_earlier_run_are_removed() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[&["--film", "gif", "--format", "jpg"]]);
    assert!(names(folder.path()).contains(&"film.gif".to_owned()));
    done(folder.path(), &[&["--film", "apng", "--no-frames"]]);
    assert_eq!(names(folder.path()), ["film.apng", "game.json"]);
    // A part stands beside the whole.
    done(folder.path(), &[&["--film", "gif", "--no-frames", "--frames", "1-2"]]);
    let expected = ["film.apng", "film_00001-00002.gif", "game.json", "game_00001-00002.json"];
    assert_eq!(names(folder.path()), expected);
}

/// By the usual names, by names of its own, and by those of the manifest; what is not ours stays.
#[test]
fn pictures_of_an_earlier_run_are_removed() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[&["--names", "move-##.bmp"]]);
    fs::write(folder.path().join(FOLDER).join("mine.png"), b"").unwrap();
    done(folder.path(), &[&["--to", "1w"]]);
    assert_eq!(
        names(folder.path()),
        ["frame_00000.png", "frame_00001.png", "game.json", "mine.png"]
    );
    // A film of a part needs no room.
    done(folder.path(), &[&["--to", "1w", "--film", "gif", "--no-frames", "--frames", "1-1"]]);
    assert!(names(folder.path()).contains(&"frame_00001.png".to_owned()));
}

#[test]
fn what_cannot_be_a_film_is_refused_before_any_work() {
    for (options, expected) in [
        (&["--film", "avi"][..], "gif, apng, webp, mp4"),
        (&["--no-frames"], "--film"),
        (&["--film", "gif", "--no-frames", "--names", "%d.png"], "--names"),
        (&["--names", "frame.png"], "no number"),
        (&["--format", "gif"], "png, jpg, bmp, tiff, webp"),
        (&["--fps", "30"], "--film"),
        #[cfg(feature = "webp")]
        (&["--film", "webp", "--size", "16384x4"], "1x1 to 16383x16383 for webp, found 16384x4"),
        #[cfg(feature = "h264")]
        (&["--film", "mp4", "--size", "14x48"], "16x16 to 3840x2160 for mp4 without ffmpeg"),
        #[cfg(feature = "h264")]
        (&["--film", "mp4", "--size", "2400x2400"], "found 2400x2400"),
        #[cfg(feature = "h264")]
        (&["--film", "mp4", "--transparent"], "mp4 cannot be transparent"),
        #[cfg(not(feature = "h264"))]
        (&["--film", "mp4"], "this build has no mp4, and ffmpeg is not installed"),
        #[cfg(not(feature = "webp"))]
        (&["--film", "webp"], "this build has no webp"),
        (&["--transparent", "--format", "jpg"], "png, tiff or webp"),
        (&["--film", "mp4", "--ffmpeg", "game.pgn"], "game.pgn: cannot be started"),
        (&["--film", "mp4", "--ffmpeg", "nowhere"], "nowhere: cannot be started"),
        (&["--for", "cinema"], "square, wide, tall, gif"),
    ] {
        let folder = TempDir::new().unwrap();
        let (code, said) = run(folder.path(), "", &[options]);
        assert_eq!(code, 2, "{options:?}: {said}");
        assert!(said.contains(expected), "{options:?}: {said}");
        assert!(!folder.path().join("out").exists(), "{options:?}");
    }
}

/// Stand-ins for ffmpeg.
#[cfg(unix)]
mod stand_ins {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    fn program(folder: &Path, script: &str) -> String {
        let path = folder.join("my-ffmpeg");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        path.to_str().unwrap().to_owned()
    }

    const KNOWN: &str = "case \"$*\" in *-version) echo 'ffmpeg version 0'; exit;; \
        *encoder=*) echo 'Encoder libx264 [x]:'; exit;; esac\n";

    #[test]
    fn another_program_is_told_from_ffmpeg() {
        for (script, expected) in [
            ("echo Hello", "is not ffmpeg, its -version says `Hello`"),
            ("echo ffmpeg version 0", "has no encoder libx264"),
        ] {
            let folder = TempDir::new().unwrap();
            let program = program(folder.path(), script);
            let options = ["--film", "mp4", "--ffmpeg", program.as_str()];
            let (code, said) = run(folder.path(), "", &[&options]);
            assert_eq!(code, 2, "{said}");
            assert!(said.contains(expected), "{said}");
        }
    }

    #[test]
    fn an_ffmpeg_that_fails_midway_has_the_last_word_and_pictures_stay() {
        let folder = TempDir::new().unwrap();
        let fails = "/usr/bin/head -c 20000 >/dev/null; echo 'the disk is full' >&2; exit 7";
        let program = program(folder.path(), &format!("{KNOWN}{fails}"));
        let options = ["--film", "mp4", "--ffmpeg", program.as_str()];
        let (code, said) = run(folder.path(), "", &[&TIMES, &options]);
        assert_eq!(code, 1, "{said}");
        assert!(said.contains("film.mp4: cannot be written: ffmpeg failed"), "{said}");
        assert!(said.contains("the disk is full"), "{said}");
        let names = names(folder.path());
        assert!(names.contains(&"frame_00000.png".to_owned()), "{names:?}");
        assert!(
            names.iter().all(|name| name.starts_with("frame_") || name == "game.json"),
            "{names:?}"
        );
        assert!(!pictures(folder.path()).is_empty());
    }

    /// Hidden files are those that are not whole.
    #[test]
    fn an_ffmpeg_that_hangs_does_not_keep_ctrl_c_from_its_work() {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("game.pgn"), GAME).unwrap();
        let program =
            program(folder.path(), &format!("{KNOWN}: > hangs; while :; do /bin/sleep 1; done"));
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_lightsquare"))
            .current_dir(folder.path())
            .args([
                "render", "game.pgn", "--size", "400x400", "--film", "mp4", "--ffmpeg", &program,
            ])
            .args(TIMES)
            .args(PLAIN)
            .stderr(std::process::Stdio::null())
            .spawn()
            .unwrap();
        while !folder.path().join("hangs").exists() {
            std::thread::yield_now();
        }
        let id = child.id().to_string();
        assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(130));
        let names = names(folder.path());
        assert!(
            names.iter().all(|name| !name.contains("film") && !name.starts_with('.')),
            "{names:?}"
        );
    }

    #[test]
    fn an_ffmpeg_that_writes_nothing_has_failed() {
        let folder = TempDir::new().unwrap();
        for (script, expected) in [
            ("/bin/cat > /dev/null", "without having written anything"),
            ("exit 0", "ffmpeg ended"),
        ] {
            let program = program(folder.path(), &format!("{KNOWN}{script}"));
            let options = ["--film", "mp4", "--ffmpeg", program.as_str(), "--no-frames"];
            let (code, said) = run(folder.path(), "", &[&TIMES, &options]);
            assert!(code == 1 && said.contains(expected), "{said}");
            assert_eq!(names(folder.path()), ["game.json"]);
            assert!(manifest(folder.path()).get("films").is_none());
        }
    }

    #[test]
    fn an_ffmpeg_gets_every_picture_for_its_time() {
        let folder = TempDir::new().unwrap();
        // What it is told, and how much it is given.
        let counts = "echo \"$*\" > told; /usr/bin/tee got.bytes | /usr/bin/wc -c > got; \
            for file; do :; done; echo film > \"${file#file:}\"";
        let program = program(folder.path(), &format!("{KNOWN}{counts}"));
        let options = ["--film", "mp4", "--ffmpeg", program.as_str(), "--fps", "30", "--no-frames"];
        let (code, said) = run(folder.path(), "", &[&TIMES, &options]);
        assert_eq!(code, 0, "{said}");
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(read("got").trim(), (135 * 48 * 32 * 3 / 2).to_string());
        assert!(read("told").contains("-video_size 48x32 -framerate 30 -i pipe:0"));
    }
}
