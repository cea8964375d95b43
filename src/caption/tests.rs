//! What captions look like, as facts.

use image::{DynamicImage, GenericImageView, RgbImage, Rgba, RgbaImage};

use super::bar::share;
use super::canvas::Canvas;
use super::font::{Fonts, Weight};
use super::measures::{Measures, Rows};
use super::text::{Line, Span};
use super::*;
use crate::config::{self as settings, Captions};

fn config(width: u32, height: u32) -> Config {
    let captions = Captions { show: true, ..Captions::default() };
    Config { width, height, captions, ..Config::default() }
}

fn line(text: &str) -> Line {
    Line::new(vec![Span::new(&Fonts::new(), text, Weight::Bold, [255; 3])], 0.3, 20.0)
}

fn content() -> Content {
    let player = |name: &str| Player {
        name: name.to_owned(),
        title: "GM".to_owned(),
        rating: "2700".to_owned(),
        clock: "1:02".to_owned(),
    };
    Content {
        players: [player("Morphy, Paul"), player("Duke Karl / Count Isouard")],
        has_clocks: true,
        to_move: Some(Color::White),
        moved: "16… Nxb8??".to_owned(),
        occasion: vec!["Paris".to_owned(), "1858".to_owned()],
        gauge: Some(Gauge::mate(1)),
        ..Content::default()
    }
}

#[test]
fn letters_of_europe_and_vietnam_have_glyphs() {
    let fonts = Fonts::new();
    let names = [
        "Přerov Žďár Řehoř Ťok Ňuňo Ůsvit",
        "Łęczyński Ąśćźż Őry Űrge Ștefan Țuca Ğül Şahin İpek Þór Eiðs Ævar Øst Åse ß",
        "Nguyễn Ngọc Trường Sơn Lê Quang Liêm Đặng Ỹ",
        "Παπαϊωάννου Ιωάννης Σωτήρης ΰ",
        "Непомнящий Щукин Ёлкин Їжак Ґалаґан Ђорђе Џоковић",
        "±∓∞⩲⩱−½…–!?#=+—’“”·",
    ];
    for weight in [Weight::Regular, Weight::Bold] {
        for letter in names.iter().flat_map(|name| name.chars()) {
            assert!(fonts.face(weight).has(letter), "{letter} {weight:?}");
        }
    }
}

#[test]
fn other_letters_are_transliterated() {
    let fonts = Fonts::new();
    for (text, spelled) in [
        ("李超", "Li Chao"),
        ("Արոնյան", "Aronyan"),
        ("ადამია", "adamia"),
        ("♘f3", "Nf3"),
        ("e\u{301}a\u{308}", "éä"),
        ("  a\tb\u{7}\n", "a b"),
        ("\u{e000}", ""),
    ] {
        assert_eq!(fonts.face(Weight::Bold).spelled(text), spelled, "{text}");
    }
}

#[test]
fn pairs_are_kerned() {
    let fonts = Fonts::new();
    for weight in [Weight::Regular, Weight::Bold] {
        let face = fonts.face(weight);
        for (left, right) in [('T', 'o'), ('A', 'V'), ('Г', 'о'), ('Ρ', 'α')] {
            let kern = face.kern(left, right);
            assert!((-0.2..0.0).contains(&kern), "{left}{right} {kern}");
        }
        assert_eq!(face.kern('H', 'H'), 0.0);
    }
}

#[test]
fn a_line_shrinks_before_it_is_cut() {
    let fonts = Fonts::new();
    let long = line("Wojtaszek-Łęczyński, Radosław");
    let width = long.width(&fonts);
    for (share, is_smaller, is_cut) in
        [(1.0, false, false), (0.85, true, false), (0.5, true, true), (0.1, true, true)]
    {
        let fitted = long.clone().fitted(&fonts, width * share);
        assert!(fitted.width(&fonts) <= width * share, "{share}");
        assert_eq!(fitted.size() < 20.0, is_smaller, "{share}");
        assert!(fitted.size() >= 16.0, "{share}");
        assert_eq!(fitted.text().ends_with('…'), is_cut, "{share}: {}", fitted.text());
    }
    assert!(long.clone().fitted(&fonts, 5.0).is_empty());
    assert!(long.fitted(&fonts, -5.0).is_empty());
    // No blank, no comma before what is left out.
    let cut = line("Nepomniachtchi, Ian Alexandrovich");
    let room = line("Nepomniachtchi…").width(&fonts) * 0.801;
    assert_eq!(cut.fitted(&fonts, room).text(), "Nepomniachtchi…");
}

#[test]
fn titles_and_ratings_go_before_names_are_cut_and_both_names_are_as_large() {
    let fonts = Fonts::new();
    let named = |name: &str| {
        let span = |text: &str| Span::new(&fonts, text, Weight::Bold, [255; 3]);
        Line::new(vec![span("GM").spare(), span(name), span("2700").spare()], 0.3, 20.0)
    };
    let [long, short] = ["Nepomniachtchi, Ian", "So, Wesley"];
    let bare = line(long).width(&fonts);
    for (room, expected) in [
        (bare * 2.0, ["GM Nepomniachtchi, Ian 2700", "GM So, Wesley 2700"]),
        (bare * 1.1, ["Nepomniachtchi, Ian 2700", "So, Wesley 2700"]),
        (bare * 0.9, ["Nepomniachtchi, Ian", "So, Wesley"]),
    ] {
        let lines = Line::both_fitted([named(long), named(short)], &fonts, room);
        assert_eq!(lines.each_ref().map(Line::text), expected);
        assert_eq!(lines[0].size(), lines[1].size());
    }
}

#[test]
fn digits_of_clocks_are_of_one_width() {
    let fonts = Fonts::new();
    let width = |text| {
        let span = Span::new(&fonts, text, Weight::Regular, [255; 3]).tabular();
        Line::new(vec![span], 0.0, 20.0).width(&fonts)
    };
    assert_eq!(width("1:11:11"), width("0:48:07"));
}

#[test]
fn every_letter_leaves_ink_and_blanks_do_not() {
    let fonts = Fonts::new();
    for letter in "AgЖΩễ1½∞±∓⩲⩱−…#".chars() {
        let mut canvas = Canvas::new(RgbImage::new(40, 40));
        line(&letter.to_string()).draw(&mut canvas, &fonts, 5.0, 20.0);
        let picture = canvas.into_picture();
        assert!(picture.pixels().any(|pixel| pixel.0[0] > 128), "{letter}");
        // Within the line: nothing is at the picture's edge.
        let inner = |x: u32, y: u32| (2..38).contains(&x) && (4..36).contains(&y);
        let mut outside = picture.enumerate_pixels().filter(|(x, y, _)| !inner(*x, *y));
        assert!(outside.all(|(_, _, pixel)| pixel.0 == [0; 3]), "{letter}");
    }
    let mut canvas = Canvas::new(RgbImage::new(40, 40));
    line(" ").draw(&mut canvas, &fonts, 5.0, 20.0);
    assert!(canvas.into_picture().pixels().all(|pixel| pixel.0 == [0; 3]));
}

#[test]
fn whites_share_is_the_published_curve() {
    for (pawns, percent) in [(0.0, 50.0), (1.0, 59.10), (-1.0, 40.90), (5.0, 86.31), (100.0, 100.0)]
    {
        assert!((share(pawns) * 100.0 - percent).abs() < 0.01, "{pawns}: {}", share(pawns));
    }
    for (gauge, share, label) in [
        (Gauge::even(), 0.5, ""),
        (Gauge::mate(3), 1.0, "#3"),
        (Gauge::mate(-3), 0.0, "#−3"),
        (Gauge::mated(Color::White), 0.0, "#"),
        (Gauge::mated(Color::Black), 1.0, "#"),
    ] {
        assert_eq!((gauge.share, gauge.label.as_str()), (share, label));
    }
    let labels = [
        (1.24, "+1.2"),
        (-0.4, "−0.4"),
        (0.04, "0.0"),
        (-0.04, "0.0"),
        (0.05, "+0.1"),
        (12.0, "+12.0"),
    ];
    for (pawns, label) in labels {
        assert_eq!(Gauge::pawns(pawns).label, label);
    }
}

#[test]
fn the_bar_is_white_as_far_as_whites_share() {
    let caption = Caption::new(&config(400, 240)).unwrap();
    let scene = DynamicImage::new_rgb8(400, caption.scene_height());
    for share in [0.0, 0.25, 0.8, 1.0] {
        let gauge = Some(Gauge { share, label: String::new() });
        let picture = caption.draw(&scene, &Content { gauge, ..Content::default() }).to_rgb8();
        let row = (0..400).map(|x| picture.get_pixel(x, caption.scene_height() + 1).0);
        let white = row.filter(|pixel| *pixel == caption.tone.white).count() as f64;
        assert!((white / 400.0 - share).abs() < 0.01, "{share}: {white}");
    }
}

#[test]
fn the_strip_leaves_the_scene_as_it_is() {
    for (width, height) in [(120, 76), (320, 180), (300, 500)] {
        let caption = Caption::new(&config(width, height)).unwrap();
        let above = caption.scene_height();
        assert!(above < height && above * 4 >= height * 3, "{above} of {height}");
        let noise = |x: u32, y: u32| (x * 7 + y * 13) as u8;
        let opaque = RgbImage::from_fn(width, above, |x, y| Rgb([noise(x, y); 3]));
        let glassy = RgbaImage::from_fn(width, above, |x, y| Rgba([noise(x, y); 4]));
        for scene in [DynamicImage::from(opaque), DynamicImage::from(glassy)] {
            let picture = caption.draw(&scene, &content());
            assert_eq!(picture.dimensions(), (width, height));
            assert_eq!(picture.color(), scene.color());
            assert_eq!(picture.crop_imm(0, 0, width, above), scene);
            let strip = picture.crop_imm(0, above, width, height - above);
            assert!(strip.pixels().all(|(_, _, Rgba([.., alpha]))| alpha == 255));
            let ink = |pixel: Rgba<u8>| pixel.0[..3] == caption.tone.ink;
            assert!(strip.pixels().any(|(_, _, pixel)| ink(pixel)), "{width} x {height}");
            assert_eq!(caption.draw(&scene, &content()), picture);
        }
    }
}

/// The strip of a picture.
fn strip(width: u32, height: u32, content: &Content) -> DynamicImage {
    let caption = Caption::new(&config(width, height)).unwrap();
    let above = caption.scene_height();
    let scene = DynamicImage::new_rgb8(width, above);
    caption.draw(&scene, content).crop_imm(0, above, width, height - above)
}

/// After a move, and judged by a number.
fn told(moved: &str, label: &str) -> Content {
    let gauge = Some(Gauge { share: 0.5, label: label.to_owned() });
    Content { moved: moved.to_owned(), gauge, ..content() }
}

#[test]
fn names_stand_still_whatever_the_move() {
    for (width, height) in [(300, 100), (320, 180), (480, 320), (160, 400)] {
        let names = |content: &Content| {
            let strip = strip(width, height, content);
            let rows = if height > width { strip.height() / 2 } else { strip.height() };
            strip.crop_imm(0, 0, width / 4, rows)
        };
        let start = names(&told("", ""));
        for (moved, label) in [("1. e4", ""), ("1. e4", "+0.3"), ("99… Rdxd8=Q+!!", "−10.0")] {
            assert_eq!(names(&told(moved, label)), start, "{moved} {label} {width} x {height}");
        }
    }
}

#[test]
fn names_have_the_same_room_whatever_the_clocks_show() {
    let names = |clock: &str| {
        let players = content().players.map(|player| Player { clock: clock.to_owned(), ..player });
        let strip = strip(160, 400, &Content { players, ..content() });
        strip.crop_imm(0, 0, 100, strip.height() / 2)
    };
    assert_eq!(names(""), names("1:02:03"));
    assert_eq!(names("0:59"), names("1:02:03"));
}

#[test]
fn room_is_kept_only_for_clocks_that_there_are() {
    let last_ink = |has_clocks: bool| {
        let players = content().players.map(|player| Player { clock: String::new(), ..player });
        let strip = strip(300, 100, &Content { players, has_clocks, ..content() }).to_rgb8();
        let ink = strip.enumerate_pixels().filter(|(_, y, pixel)| *y > 4 && pixel.0[0] > 200);
        ink.map(|(x, ..)| x).max().unwrap()
    };
    assert!(last_ink(false) > 270 && last_ink(true) < 250);
}

#[test]
fn in_a_narrow_picture_names_stand_below_each_other_if_there_is_room() {
    for (width, height, rows) in [
        (160, 400, Rows::Four),
        (160, 247, Rows::Two),
        (160, 100, Rows::One),
        (299, 400, Rows::Four),
        (300, 400, Rows::Two),
        (1200, 800, Rows::Two),
    ] {
        let strip = strip_height(&Captions::default(), width, height).unwrap();
        assert_eq!(Measures::of(width as f32, strip as f32).rows, rows, "{width} x {height}");
    }
    let [white, black] = content().players;
    let other = |player: &Player| Player { name: "So, Wesley".to_owned(), ..player.clone() };
    let both = strip(160, 400, &content());
    for players in [[other(&white), black.clone()], [white.clone(), other(&black)]] {
        assert_ne!(strip(160, 400, &Content { players, ..content() }), both);
    }
}

#[test]
fn where_the_number_has_no_room_the_move_stays_whole() {
    let drawn = |moved: &str, label: &str| strip(120, 76, &told(moved, label));
    assert_ne!(drawn("1. e4", "+0.3"), drawn("1. e4", ""));
    assert_eq!(drawn("9. cxd8=Q+!", "+0.3"), drawn("9. cxd8=Q+!", ""));
    assert_ne!(drawn("9. cxd8=Q+!", ""), drawn("9. cxd8=Q+?", ""));
}

#[test]
fn a_result_card_names_both_players_however_long_they_are() {
    let card = |white: &str, black: &str| {
        let player = |first: &str| Player {
            name: format!("{first} Непомнящий-Константинопольский, Александр Владимирович"),
            ..Player::default()
        };
        let players = [player(white), player(black)];
        let scene = DynamicImage::new_rgb8(240, 160);
        let card = Some(Card::Result);
        let mut config = config(240, 160);
        config.captions.show = false;
        let caption = Caption::new(&config).unwrap();
        caption.draw(&scene, &Content { players, card, ..Content::default() })
    };
    let both = card("A", "B");
    assert!(card("C", "B") != both && card("A", "C") != both);
}

#[test]
fn light_pictures_have_light_strips() {
    for (theme, tone, is_light) in [
        ("wood", settings::Tone::Auto, false),
        ("print", settings::Tone::Auto, true),
        ("thesis", settings::Tone::Auto, false),
        ("print", settings::Tone::Dark, false),
        ("wood", settings::Tone::Light, true),
    ] {
        let mut config = config(120, 80);
        config.theme = theme.to_owned();
        config.captions.tone = tone;
        let ground = Caption::new(&config).unwrap().tone.ground;
        assert_eq!(ground[0] > 128, is_light, "{theme} {tone:?}");
    }
}

#[test]
fn what_is_too_small_for_words_is_refused() {
    let height = |height| Captions { height, ..Captions::default() };
    for (settings, width, tall, expected) in [
        (height(0.0), 1200, 800, Some(75)),
        (height(0.1), 1200, 800, Some(80)),
        (height(0.0), 120, 76, Some(19)),
        (height(0.0), 119, 76, None),
        (height(0.0), 120, 75, None),
        (height(0.0), 16, 16, None),
        (height(0.0), 1, 1, None),
        (height(0.01), 1200, 800, None),
    ] {
        assert_eq!(strip_height(&settings, width, tall).ok(), expected, "{width} x {tall}");
    }
    let message = Caption::new(&config(64, 48)).err().map(|error| error.to_string());
    let expected =
        "captions: a picture of 64 x 48 pixels has no room for them, expected at least 120 x 76";
    assert_eq!(message.as_deref(), Some(expected));
}

#[test]
fn strips_of_all_sizes_can_be_drawn() {
    for (width, height) in
        [(120, 76), (120, 4000), (4000, 76), (320, 180), (640, 640), (3840, 2160)]
    {
        for share in [0.0, 0.3] {
            let mut config = config(width, height);
            config.captions.height = share;
            let caption = Caption::new(&config).unwrap();
            let scene = DynamicImage::new_rgb8(width, caption.scene_height());
            for content in [content(), Content::default()] {
                assert_eq!(caption.draw(&scene, &content).dimensions(), (width, height));
            }
        }
    }
}

#[test]
fn cards_need_no_strip_and_fit_any_size() {
    for (width, height) in [(1, 1), (16, 16), (120, 80), (300, 60), (60, 300)] {
        let mut config = config(width, height);
        config.captions.show = false;
        let caption = Caption::new(&config).unwrap();
        assert_eq!(caption.scene_height(), height);
        let scene = DynamicImage::ImageRgba8(RgbaImage::new(width, height));
        for card in [Card::Title, Card::Result] {
            let said = Content { card: Some(card), result: "1–0".to_owned(), ..content() };
            let silent = Content { card: Some(card), ..Content::default() };
            let [said, silent] = [said, silent].map(|content| caption.draw(&scene, &content));
            assert_eq!(said.dimensions(), (width, height));
            assert!(!said.color().has_alpha());
            assert_eq!(said != silent, width.min(height) >= 60, "{width} x {height}");
        }
    }
}
