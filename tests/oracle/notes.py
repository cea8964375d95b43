#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what lightsquare says of moves and variations with what python-chess does.

    notes.py FILE.pgn < NOTES.tsv

NOTES.tsv is what `lightsquare inspect --notes` prints: for each game from 1 on
a row for the start, one for each ply of the main line, and one for each ply of
every variation. Prints the differences and a summary; exits with 1 if there is
any difference.
"""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

import chess.engine
import chess.pgn

import table

# Variations with a wrong move number, which python-chess does not look at, and lightsquare does.
MISNUMBERED = {("linares_2002.pgn", 16): {"34w-qxg5"}}
COLUMNS = ["game", "variation", "ply", "san", "clk", "emt", "eval", "csl", "cal", "nags"]


@dataclass
class Line:
    """A line as brackets make it: its moves, and variations by the move that they replace."""

    moves: list = field(default_factory=list)  # of a node and its SAN; None is a null move
    variations: list = field(default_factory=list)  # of an index of `moves` and a line


class LineBuilder(chess.pgn.GameBuilder):
    """Builds the usual tree, and keeps which bracket each of its nodes stood in."""

    def begin_game(self):
        super().begin_game()
        self.lines = [Line()]

    def begin_variation(self):
        super().begin_variation()
        line = Line()
        self.lines[-1].variations.append((len(self.lines[-1].moves) - 1, line))
        self.lines.append(line)

    def end_variation(self):
        super().end_variation()
        self.lines.pop()

    def visit_move(self, board, move):
        super().visit_move(board, move)
        san = board.san(move) if move else None
        self.lines[-1].moves.append((self.variation_stack[-1], san))

    def result(self):
        return self.game, self.lines[0]


def name_of(node, san):
    """The name of a variation that begins with a node: `12w-nf3`."""
    board = node.parent.board()
    color = "w" if board.turn == chess.WHITE else "b"
    return f"{board.fullmove_number}{color}-" + re.sub("[^a-z0-9-]", "", san.lower())


def named_lines(line, ply=0, path=()):
    """A line's moves up to the first null move, and its variations', outermost first."""
    level = [(path, ply, line)]
    while level:
        deeper = []
        for path, ply, line in level:
            nulls = (index for index, (_, san) in enumerate(line.moves) if san is None)
            length = next(nulls, len(line.moves))
            yield "/".join(path) or "-", ply, line.moves[:length]
            times = {}
            for index, variation in line.variations:
                if index < length and variation.moves and variation.moves[0][1] is not None:
                    name = name_of(*variation.moves[0])
                    times[name] = times.get(name, 0) + 1
                    unique = name if times[name] == 1 else f"{name}-{times[name]}"
                    deeper.append((path + (unique,), ply + index, variation))
        level = deeper


def number_or_dash(number):
    return "-" if number is None else f"{number:g}"


def eval_of(node):
    score = node.eval()
    if score is None:
        return "-"
    score = score.white()
    return f"#{score.mate()}" if score.is_mate() else f"{score.score() / 100:g}"


def row(number, name, ply, san, node):
    marks = [arrow.pgn() for arrow in node.arrows()]
    cells = [
        [mark for mark in marks if len(mark) == 3],
        [mark for mark in marks if len(mark) == 5],
        [str(nag) for nag in sorted(node.nags)],
    ]
    said = [number_or_dash(node.clock()), number_or_dash(node.emt()), eval_of(node)]
    return [str(number), name, str(ply), san, *said, *(",".join(cell) or "-" for cell in cells)]


def expected_rows(number, game, main):
    yield row(number, "-", 0, "-", game)
    for name, ply, moves in named_lines(main):
        for ply, (node, san) in enumerate(moves, start=ply + 1):
            yield row(number, name, ply, san, node)


def expected_games(path):
    for number, (game, main) in table.games(path, LineBuilder):
        left_out = MISNUMBERED.get((Path(path).name, number), ())
        rows = expected_rows(number, game, main)
        yield number, [row for row in rows if row[1].split("/")[0] not in left_out]


def main(path):
    games, rows, found = table.compare(path, COLUMNS, expected_games(path))
    print(f"{path}: {games} games, {rows} rows of notes, {found} differences")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: notes.py FILE.pgn < NOTES.tsv")
    sys.exit(main(sys.argv[1]))
