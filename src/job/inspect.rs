//! What a file holds: games, all their positions, or what is said of their moves.

use std::fmt::Display;
use std::io::Write;
use std::path::PathBuf;

use super::{JobError, Progress, nothing_selected, say_missing, say_problems, say_variations};
use crate::game::{Eval, Game, Letters, Notes, Ply, Source, Wanted};
use crate::notation::Color;
use crate::text::{shortened, shown};

/// Which games to tell of, and how.
#[derive(Clone, Debug)]
pub struct InspectJob {
    /// Files of games; `-` is the standard input.
    pub inputs: Vec<PathBuf>,
    pub wanted: Wanted,
    pub letters: Letters,
    pub listing: Listing,
}

/// What is written of each game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listing {
    /// One line, and one for each problem.
    Games,
    /// A tab-separated row for every position.
    Positions,
    /// A tab-separated row for the start and for every move, those of variations too, with what
    /// comments and glyphs say.
    Notes,
}

impl Listing {
    /// The names of the columns, where there are any.
    fn header(self) -> Option<&'static str> {
        match self {
            Listing::Games => None,
            Listing::Positions => Some("game\tply\tsan\tfen\twhite\tblack"),
            Listing::Notes => Some("game\tvariation\tply\tsan\tclk\temt\teval\tcsl\tcal\tnags"),
        }
    }
}

/// Writes what the job asks for; tables have a header line a file. A file that has no game that is wanted is passed
/// over, as long as another one has. Gives the number of games that could not be read whole.
///
/// # Errors
/// Input that cannot be read, no game that is wanted in any file, or what `out` gives.
pub fn inspect(
    job: &InspectJob,
    progress: &dyn Progress,
    out: &mut dyn Write,
) -> Result<usize, JobError> {
    let is_full = |taken| job.wanted.limit.is_some_and(|limit| taken >= limit);
    let (mut seen, mut taken, mut partial) = (0, 0, 0);
    for input in &job.inputs {
        if is_full(taken) {
            break;
        }
        let file = shown(input);
        let mut games = Source::open(input)?.with_letters(job.letters).wanted(&job.wanted);
        let before = taken;
        for game in &mut games {
            let game = game?;
            if taken == before {
                begin(job, &file, out).map_err(JobError::Write)?;
            }
            taken += 1;
            partial += usize::from(!game.is_whole());
            if job.listing != Listing::Games {
                say_problems(&file, &game, progress);
            }
            let written = match job.listing {
                Listing::Games => line(&game, out),
                Listing::Positions => positions(&game, out),
                Listing::Notes => {
                    say_variations(&game.variations, &file, game.number, progress);
                    notes(&game, out)
                }
            };
            written.map_err(JobError::Write)?;
            if is_full(taken) {
                break;
            }
        }
        seen += games.seen();
        // A single file without any is an error of its own; and one that was not read to its end misses nothing.
        if taken > before || job.inputs.len() > 1 {
            let numbers = job.wanted.numbers.as_ref().filter(|_| !is_full(taken));
            say_missing(&file, numbers, games.seen(), progress);
        }
    }
    if taken == 0 {
        return Err(nothing_selected(&job.inputs, seen));
    }
    out.flush().map_err(JobError::Write)?;
    Ok(partial)
}

/// Writes what stands before the games of a file.
fn begin(job: &InspectJob, file: &str, out: &mut dyn Write) -> std::io::Result<()> {
    match job.listing.header() {
        Some(header) => writeln!(out, "{header}"),
        None if job.inputs.len() > 1 => writeln!(out, "{file}"),
        None => Ok(()),
    }
}

fn line(game: &Game, out: &mut dyn Write) -> std::io::Result<()> {
    let [white, black] =
        [Color::White, Color::Black].map(|color| shortened(game.player(color), 60));
    let (number, result, plies) = (game.number, &game.result, game.plies.len());
    write!(out, "{number:>5}  {white} – {black}  {result}  {plies} plies")?;
    for name in ["Event", "Date"] {
        if let Some(value) = game.tag(name) {
            write!(out, "  {name} {}", shortened(value, 60))?;
        }
    }
    writeln!(out)?;
    for problem in &game.problems {
        writeln!(out, "       {problem}")?;
    }
    Ok(())
}

fn positions(game: &Game, out: &mut dyn Write) -> std::io::Result<()> {
    if !game.start_is_known {
        return Ok(());
    }
    for ply in 0..=game.plies.len() {
        let placement = game.placement(ply);
        let [white, black] = [Color::White, Color::Black].map(|color| placement.notation(color));
        let san = game.san(ply).unwrap_or_else(|| "-".to_owned());
        let fen = game.fen(ply);
        writeln!(out, "{}\t{ply}\t{san}\t{fen}\t{white}\t{black}", game.number)?;
    }
    Ok(())
}

fn notes(game: &Game, out: &mut dyn Write) -> std::io::Result<()> {
    if !game.start_is_known {
        return Ok(());
    }
    let number = game.number;
    let mut row = |line: &str, ply: usize, san: &dyn Display, notes: &Notes| {
        write!(out, "{number}\t{line}\t{ply}\t{san}")?;
        let eval = notes.eval.map(|eval| match eval {
            Eval::Pawns(pawns) => pawns.to_string(),
            Eval::Mate(moves) => format!("#{moves}"),
        });
        let [clock, elapsed] =
            [notes.clock, notes.elapsed].map(|seconds| seconds.map(|s| s.to_string()));
        let marks = [list(&notes.circles), list(&notes.arrows), list(&notes.glyphs)];
        for cell in [clock, elapsed, eval].into_iter().chain(marks) {
            write!(out, "\t{}", cell.as_deref().unwrap_or("-"))?;
        }
        writeln!(out)
    };
    row("-", 0, &"-", &game.start_notes)?;
    for (ply, Ply { san, notes, .. }) in (1..).zip(&game.plies) {
        row("-", ply, san, notes)?;
    }
    for branch in game.branches() {
        let name = branch.names.join("/");
        let Some(variation) = game.variation(&branch.path) else {
            continue;
        };
        for (ply, Ply { san, notes, .. }) in (variation.ply + 1..).zip(&variation.plies) {
            row(&name, ply, san, notes)?;
        }
    }
    Ok(())
}

/// Several things in one cell; `None` for none.
fn list<T: Display>(items: &[T]) -> Option<String> {
    let items: Vec<String> = items.iter().map(T::to_string).collect();
    (!items.is_empty()).then(|| items.join(","))
}
