//! Sample games with something wrong in them: whatever it is, games are read, and only positions that follow from each
//! other are shown.

use std::fs;
use std::path::{Path, PathBuf};

use lightsquare::game::{Game, Scanner};

/// How many spoilt texts are made of each file.
const MUTANTS: usize = 1000;

/// The longest piece of a file that is spoilt, in bytes.
const LONGEST: usize = 20_000;

/// What files are spoilt with.
const PIECES: [&[u8]; 22] = [
    b"{", b"}", b"(", b")", b"[", b"]", b"\"", b"\n", b"\r", b"\n\n", b";", b"%", b"*", b"1.",
    b"1-0", b"O-O-O", b"\xff", b"\0", b"[FEN \"", b"exd8=Q", b"$255", b"--",
];

/// The same numbers each time (xorshift64*, Vigna 2016).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % end.max(1)
    }
}

fn spoilt(text: &[u8], random: &mut Random) -> Vec<u8> {
    let start = random.below(text.len().saturating_sub(LONGEST) + 1);
    let mut text = text[start..text.len().min(start + LONGEST)].to_vec();
    for _ in 0..=random.below(6) {
        let at = random.below(text.len());
        let end = (at + random.below(40)).min(text.len());
        match random.below(4) {
            0 => drop(text.drain(at..end)),
            1 => drop(text.splice(at..at, PIECES[random.below(PIECES.len())].iter().copied())),
            2 => text.extend_from_within(at..end),
            _ => text[at..end].iter_mut().for_each(|byte| *byte ^= 1 << random.below(8)),
        }
        if text.is_empty() {
            break;
        }
    }
    text
}

fn samples() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = [
        "games",
        "tests/data",
        "../shared/games",
        "../shared/games/strange",
        "../shared/games/classic",
    ];
    let entries =
        folders.iter().flat_map(|folder| fs::read_dir(root.join(folder)).into_iter().flatten());
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "pgn"));
    files.sort();
    files
}

#[test]
fn spoilt_games_are_read_up_to_what_is_spoilt() {
    let mut games = 0;
    for (seed, path) in (1..).zip(samples()) {
        let text = fs::read(&path).unwrap();
        let mut random = Random(seed);
        for mutant in 0..MUTANTS {
            let spoilt = spoilt(&text, &mut random);
            for (number, scanned) in (1..).zip(Scanner::new(&spoilt[..])) {
                let game = Game::read(scanned.unwrap(), number);
                let problems = game.problems.iter().map(ToString::to_string);
                for said in problems.chain(game.unread_tags.iter().cloned()) {
                    assert!(
                        !said.contains(char::is_control),
                        "{}, {mutant}: {said}",
                        path.display()
                    );
                }
                // Each position is that of a legal move from the one before, and has a name.
                for ply in 1..=game.plies.len() {
                    let before = game.position(ply - 1).unwrap();
                    let played = game.plies[ply - 1].played;
                    assert!(
                        shakmaty::Position::is_legal(&before, played),
                        "{}, {mutant}",
                        path.display()
                    );
                    assert!(!game.fen(ply).is_empty());
                }
                games += 1;
            }
        }
    }
    assert!(games > 20_000, "{games}");
}
