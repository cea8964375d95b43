#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the positions that lightsquare prints with those of python-chess.

    positions.py FILE.pgn < POSITIONS.tsv

POSITIONS.tsv has the header `game ply san fen white black` (tab-separated) and,
for each game from 1 on, a row for the start (ply 0, san `-`) and one for each
ply of the main line. Prints the differences and a summary; exits with 1 if
there is any difference.
"""

import re
import sys

import chess

import table

COLUMNS = ["game", "ply", "san", "fen", "white", "black"]
LETTERS = {
    chess.KING: "K",
    chess.QUEEN: "D",
    chess.ROOK: "V",
    chess.BISHOP: "S",
    chess.KNIGHT: "J",
    chess.PAWN: "P",
}


def notation(board, color):
    """One side's pieces, from its own first rank on, files a to h: `VA1JB1…`."""
    ranks = range(8) if color == chess.WHITE else reversed(range(8))
    squares = (chess.square(file, rank) for rank in ranks for file in range(8))
    return "".join(
        LETTERS[board.piece_type_at(square)] + chess.square_name(square).upper()
        for square in squares
        if board.color_at(square) == color
    )


def fen(board):
    """A board's FEN, with what is in hand from the pawn up, as lichess writes it."""

    def in_order(match):
        return "[" + "".join(sorted(match[1], key="PNBRQpnbrq".index)) + "]"

    return re.sub(r"\[(\w*)\]", in_order, board.fen())


def push(board, move):
    """Makes a move. A pawn that is dropped is a pawn's move, after which the clock of half-moves begins anew."""
    board.push(move)
    if move.drop == chess.PAWN:
        board.halfmove_clock = 0


def expected_rows(number, game):
    """A game's rows by python-chess, up to the first null move."""

    def row(san):
        sides = (notation(board, color) for color in (chess.WHITE, chess.BLACK))
        return [str(number), str(ply), san, fen(board), *sides]

    board, ply = game.board(), 0
    yield row("-")
    for ply, move in enumerate(game.mainline_moves(), start=1):
        if not move:
            return
        san = board.san(move)
        push(board, move)
        yield row(san)


def expected_games(path):
    """Each game's number and rows by python-chess; no rows if it has no board for it."""
    for number, game in table.games(path):
        try:
            yield number, list(expected_rows(number, game))
        except ValueError as error:
            print(f"{path}: game {number}: python-chess: {error}")
            yield number, []


def main(path):
    games, rows, found = table.compare(path, COLUMNS, expected_games(path))
    print(f"{path}: {games} games, {rows} positions, {found} differences")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: positions.py FILE.pgn < POSITIONS.tsv")
    sys.exit(main(sys.argv[1]))
