# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables that lightsquare prints, and how they differ from those of python-chess."""

import logging
import sys
from collections import defaultdict
from itertools import count

import chess.pgn

SHOWN = 20


def games(path, visitor=chess.pgn.GameBuilder):
    """Each game of a file with its number, as `visitor` gives it."""
    logging.getLogger("chess.pgn").setLevel(logging.CRITICAL)
    with open(path, encoding="utf-8-sig", errors="replace") as pgn:
        for number in count(1):
            game = chess.pgn.read_game(pgn, Visitor=visitor)
            if game is None:
                return
            yield number, game


def printed_games(lines, columns):
    """The rows on stdin by the number of their game."""
    rows = (line.rstrip("\r\n").split("\t") for line in lines)
    if next(rows, None) != columns:
        sys.exit(f"stdin: the header is not {' '.join(columns)}")
    games = defaultdict(list)
    for line, row in enumerate(rows, start=2):
        if len(row) != len(columns) or not row[0].isdecimal():
            sys.exit(f"stdin, line {line}: not a row of {len(columns)} columns: {row}")
        games[int(row[0])].append(row)
    return games


def differences(number, columns, ours, theirs):
    """Where two lists of rows differ: place, our value, python-chess's value."""
    if len(ours) != len(theirs):
        yield f"game {number}, number of rows", len(ours), len(theirs)
    for index, (our_row, their_row) in enumerate(zip(ours, theirs)):
        for column, our, their in zip(columns, our_row, their_row):
            if our != their:
                yield f"game {number}, row {index}, {column}", our, their


def compare(path, columns, expected):
    """Holds the rows on stdin against `expected`, pairs of a game's number and its rows.

    Prints the differences; gives the number of games, of rows, and of differences.
    """
    printed = printed_games(sys.stdin, columns)
    games = rows = 0
    found = []
    for number, theirs in expected:
        games, rows = number, rows + len(theirs)
        found += differences(number, columns, printed.pop(number, []), theirs)
    for number, ours in sorted(printed.items()):
        found += differences(number, columns, ours, [])

    for place, ours, theirs in found[:SHOWN]:
        print(f"{path}: {place}: ours {ours!r}, python-chess {theirs!r}")
    if len(found) > SHOWN:
        print(f"{path}: and {len(found) - SHOWN} more")
    return games, rows, len(found)
