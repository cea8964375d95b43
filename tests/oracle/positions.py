#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the positions that lightsquare prints with those of python-chess.

    positions.py FILE.pgn < POSITIONS.tsv

POSITIONS.tsv has the header `game ply san fen white black` (tab-separated) and,
for each game from 1 on, a row for the start (ply 0, san `-`) and one for each
ply of the main line. Prints the differences and a summary; exits with 1 if
there is any difference.
"""

import logging
import sys
from collections import defaultdict
from itertools import count

import chess
import chess.pgn

COLUMNS = ["game", "ply", "san", "fen", "white", "black"]
LETTERS = {
    chess.KING: "K",
    chess.QUEEN: "D",
    chess.ROOK: "V",
    chess.BISHOP: "S",
    chess.KNIGHT: "J",
    chess.PAWN: "P",
}
SHOWN = 20


def notation(board, color):
    """One side's pieces, from its own first rank on, files a to h: `VA1JB1…`."""
    ranks = range(8) if color == chess.WHITE else reversed(range(8))
    squares = (chess.square(file, rank) for rank in ranks for file in range(8))
    return "".join(
        LETTERS[board.piece_type_at(square)] + chess.square_name(square).upper()
        for square in squares
        if board.color_at(square) == color
    )


def expected_rows(number, game):
    """A game's rows by python-chess, up to the first null move."""

    def row(san):
        sides = (notation(board, color) for color in (chess.WHITE, chess.BLACK))
        return [str(number), str(ply), san, board.fen(), *sides]

    board, ply = game.board(), 0
    yield row("-")
    for ply, move in enumerate(game.mainline_moves(), start=1):
        if not move:
            return
        san = board.san(move)
        board.push(move)
        yield row(san)


def expected_games(path):
    """Each game's number and rows by python-chess; no rows if it has no board for it."""
    with open(path, encoding="utf-8-sig", errors="replace") as pgn:
        for number in count(1):
            game = chess.pgn.read_game(pgn)
            if game is None:
                return
            try:
                yield number, list(expected_rows(number, game))
            except ValueError as error:
                print(f"{path}: game {number}: python-chess: {error}")
                yield number, []


def printed_games(lines):
    """The rows on stdin by the number of their game."""
    rows = (line.rstrip("\r\n").split("\t") for line in lines)
    if next(rows, None) != COLUMNS:
        sys.exit(f"stdin: the header is not {' '.join(COLUMNS)}")
    games = defaultdict(list)
    for line, row in enumerate(rows, start=2):
        if len(row) != len(COLUMNS) or not row[0].isdecimal():
            sys.exit(f"stdin, line {line}: not a row of {len(COLUMNS)} columns: {row}")
        games[int(row[0])].append(row)
    return games


def differences(number, ours, theirs):
    """Where two lists of rows differ: place, our value, python-chess's value."""
    if len(ours) != len(theirs):
        yield f"game {number}, number of rows", len(ours), len(theirs)
    for ply, (our_row, their_row) in enumerate(zip(ours, theirs)):
        for column, our, their in zip(COLUMNS, our_row, their_row):
            if our != their:
                yield f"game {number}, ply {ply}, {column}", our, their


def main(path):
    logging.getLogger("chess.pgn").setLevel(logging.CRITICAL)
    printed = printed_games(sys.stdin)
    games = plies = 0
    found = []
    for number, rows in expected_games(path):
        games, plies = number, plies + max(len(rows) - 1, 0)
        found += differences(number, printed.pop(number, []), rows)
    for number, rows in sorted(printed.items()):
        found += differences(number, rows, [])

    for place, ours, theirs in found[:SHOWN]:
        print(f"{path}: {place}: ours {ours!r}, python-chess {theirs!r}")
    if len(found) > SHOWN:
        print(f"{path}: and {len(found) - SHOWN} more")
    print(f"{path}: {games} games, {plies} plies, {len(found)} differences")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: positions.py FILE.pgn < POSITIONS.tsv")
    sys.exit(main(sys.argv[1]))
