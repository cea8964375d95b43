//! Input without end: whatever comes, a bounded part of it is kept, what is lost is told, and the
//! next game is read.

use std::alloc::{GlobalAlloc, Layout, System};
use std::io::{self, Read};
use std::sync::atomic::{AtomicUsize, Ordering};

use lightsquare::game::{Game, Scanner};

/// Counts what is allocated, and the most that there ever was.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let now = NOW.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST.fetch_max(now, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// A text again and again, never in memory.
struct Repeated {
    text: &'static [u8],
    at: usize,
    left: usize,
}

impl Read for Repeated {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = buffer.len().min(self.left);
        for byte in &mut buffer[..count] {
            *byte = self.text[self.at];
            self.at = (self.at + 1) % self.text.len();
        }
        self.left -= count;
        Ok(count)
    }
}

/// A game with `text` again and again within, then another game.
fn around(
    before: &'static str,
    text: &'static str,
    times: usize,
    after: &'static str,
) -> impl Read {
    let repeated = Repeated { text: text.as_bytes(), at: 0, left: text.len() * times };
    let next = "\n\n[White \"next\"]\n\n1. d4 *\n";
    before.as_bytes().chain(repeated).chain(after.as_bytes()).chain(next.as_bytes())
}

const MEGABYTE: usize = 1024 * 1024;

#[test]
fn whatever_has_no_end_is_bounded_and_told() {
    const GAME: &str = "[White \"a\"]\n\n1. e4 ";
    // What is before, what is repeated, how often, what is behind; plies that are left, and a
    // problem of the game.
    let cases = [
        (GAME, "{", "word ", 4 * MEGABYTE, "} e5 *", 2, ""),
        (GAME, "{", "[%clk 0:01] ", MEGABYTE, "} e5 *", 2, "longer than the 64 KiB"),
        (GAME, "{", "\n", 4 * MEGABYTE, "} e5 *", 2, ""),
        (GAME, ";", "word ", 4 * MEGABYTE, "\ne5 *", 2, ""),
        (GAME, "", "(", MEGABYTE, "", 1, "never closed"),
        (GAME, "", ")", MEGABYTE, "", 1, "closes nothing"),
        (GAME, "", "(d4) ", MEGABYTE, "e5 *", 2, "behind the 50000 half-moves of them"),
        (GAME, "(d4 ", "d5 ", MEGABYTE, ") e5 *", 2, ""),
        (GAME, "", "{} ", MEGABYTE, "e5 *", 2, ""),
        (GAME, "", "$1", MEGABYTE, " e5 *", 2, ""),
        (GAME, "$", "1", 4 * MEGABYTE, " e5 *", 1, "is no move"),
        (GAME, "", "x", 4 * MEGABYTE, " e5 *", 1, "is no move"),
        (GAME, "", "1", 4 * MEGABYTE, " e5 *", 1, "is no move"),
        (GAME, "", "\u{a0}", 4 * MEGABYTE, " e5 *", 1, "is no move"),
        (GAME, "<", "x", 4 * MEGABYTE, "> e5 *", 1, "may hide moves"),
        (GAME, "[", "x", 4 * MEGABYTE, "] e5 *", 1, "may hide moves"),
        (GAME, "", "[x]", MEGABYTE, " e5 *", 1, "may hide moves"),
        (GAME, "\n%", "x", 4 * MEGABYTE, "\ne5 *", 2, ""),
        (GAME, "", " ", 4 * MEGABYTE, "e5 *", 2, ""),
        (GAME, "", "\r", 4 * MEGABYTE, "e5 *", 2, ""),
        (GAME, "* ", "; x\n", MEGABYTE, "", 1, ""),
        ("", "[Event \"", "x", 4 * MEGABYTE, "\"]\n\n1. e4 *", 0, "longer than the 8 KiB"),
        ("", "[FEN \"", "8/", MEGABYTE, "\"]\n\n1. e4 *", 0, "longer than the 8 KiB"),
        ("[White \"a\"]\n", "", "[White \"b\"]\n", MEGABYTE, "\n1. e4 *", 1, "repeats a tag"),
        ("[FEN \"x\"]\n", "", "[FEN \"b\"]\n", MEGABYTE, "\n1. e4 *", 0, "says something else"),
        ("[White \"a\"]\n", "", "[x]\n", MEGABYTE, "\n1. e4 *", 1, "is no tag"),
        // These are of the game whose tags come next.
        (GAME, "e5\n", "[x]\n", MEGABYTE, "", 2, ""),
        (
            "[White \"a\"]\n\n",
            "",
            "Nf3 Nf6 Ng1 Ng8 ",
            MEGABYTE / 4,
            "*",
            20_000,
            "20000 half-moves",
        ),
        (GAME, "e5 2. ", "Qxh8 ", MEGABYTE, "*", 2, "is no legal move"),
        (GAME, "", "-- ", MEGABYTE, "*", 1, "is a null move"),
        (GAME, "", "Sf6 ", MEGABYTE, "*", 1, "is no move"),
        (GAME, "", "ed ", MEGABYTE, "*", 1, "is no legal move"),
    ];
    for (before, opens, text, times, after, plies, problem) in cases {
        let start = NOW.load(Ordering::Relaxed);
        MOST.store(start, Ordering::Relaxed);
        let name = format!("{before}{opens}{text}…{after}");
        let (mut games, mut is_told) = (0, false);
        let mut last = None;
        let text = around_all(before, opens, text, times, after);
        for scanned in Scanner::new(text) {
            let game = Game::read(scanned.unwrap(), 1);
            games += 1;
            if games == 1 {
                assert_eq!(game.plies.len(), plies, "{name}: {:?}", game.problems.first());
                is_told = game.problems.iter().any(|told| told.to_string().contains(problem));
                assert_eq!(game.problems.is_empty(), problem.is_empty(), "{name}");
                assert!(game.problems.len() < 3000, "{name}: {}", game.problems.len());
            }
            last = Some((game.tag("White").map(str::to_owned), game.plies.len()));
        }
        assert!(is_told || problem.is_empty(), "{name}: not told");
        assert_eq!((games, last), (2, Some((Some("next".to_owned()), 1))), "{name}");
        let most = MOST.load(Ordering::Relaxed) - start;
        assert!(most < 64 * MEGABYTE, "{name}: {} MB", most / MEGABYTE);
    }
}

/// Like `around`, with what opens the repeated text on its own.
fn around_all(
    before: &'static str,
    opens: &'static str,
    text: &'static str,
    times: usize,
    after: &'static str,
) -> impl Read {
    before.as_bytes().chain(around(opens, text, times, after))
}

/// Thousands of different tags: so many are read, the rest is told.
#[test]
fn tags_of_a_game_are_bounded() {
    let text: String = (0..5000).map(|n| format!("[T{n} \"{n}\"]\n")).collect();
    let text = format!("{text}\n1. e4 *\n");
    let game = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    let game = Game::read(game, 1);
    assert_eq!((game.tags.len(), game.plies.len(), game.is_whole()), (1000, 1, true));
    assert!(
        game.problems[0].to_string().contains("behind the 1000 tags"),
        "{:?}",
        game.problems[0]
    );
    // A start that is behind them is not passed over.
    let text = text.replace("[T4999 \"4999\"]", "[FEN \"8/8/8/8/8/8/8/K1k5 w - - 0 1\"]");
    let game = Game::read(Scanner::new(text.as_bytes()).next().unwrap().unwrap(), 1);
    assert!(!game.start_is_known && game.plies.is_empty());
}
