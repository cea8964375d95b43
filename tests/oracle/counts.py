#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares games and plies of a whole folder with those of python-chess.

    counts.py PROGRAM FOLDER [--table]

PROGRAM is lightsquare; each .pgn file in and below FOLDER is read by
`PROGRAM inspect --quiet --positions`. What differs must stand in
differences.tsv beside this file, with the reason: one row for each game, with
plies by both (`-` for a game that one of them does not see). Prints what is
not explained, what is explained and does not differ, and a summary; exits with
1 if there is any of these. With --table, prints the table of
docs/reading-pgn.md.
"""

import csv
import subprocess
import sys
from collections import Counter
from pathlib import Path

import table

EXPLAINED = Path(__file__).with_name("differences.tsv")


def ours(program, path):
    """Plies by the number of the game; those of which no position is known have 0."""
    plies = Counter()
    command = [program, "inspect", "--quiet", str(path)]
    listing = subprocess.run(command, capture_output=True, text=True)
    if listing.returncode not in (0, 3):
        return None
    for line in listing.stdout.splitlines():
        # Problems are indented further than numbers of games.
        if line[:5].strip().isdecimal() and line[5:7] == "  ":
            words = line.split("  ")
            count = next(word for word in words if word.endswith(" plies"))
            plies[int(line[:5])] = int(count.split()[0])
    return plies


def theirs(path):
    plies = {}
    for number, game in table.games(path):
        plies[number] = sum(1 for _ in game.mainline_moves())
    return plies


def main(program, folder, prints_table):
    with open(EXPLAINED, encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))
    explained = {(row["file"], row["game"]): row for row in rows}
    unused = set(explained)
    files = found = 0
    for path in sorted(Path(folder).rglob("*.pgn")):
        name = path.relative_to(folder).as_posix()
        our, their = ours(program, path) or {}, theirs(path)
        files += 1
        if prints_table:
            total = [len(our), len(their), sum(our.values()), sum(their.values())]
            whys = dict.fromkeys(row["why"] for (file, _), row in explained.items() if file == name)
            print(f"| {name} | {' | '.join(map(str, total))} | {'; '.join(whys)} |")
            continue
        for number in sorted(our.keys() | their.keys()):
            pair = [str(side.get(number, "-")) for side in (our, their)]
            place = (name, str(number))
            unused.discard(place)
            known = explained.get(place)
            expected = [known["plies_ours"], known["plies_python_chess"]] if known else None
            if expected != (pair if pair[0] != pair[1] else None):
                found += 1
                print(f"{name}\t{number}\t{pair[0]}\t{pair[1]}\t(explained: {expected})")
    if prints_table:
        return 0
    for name, number in sorted(unused):
        found += 1
        print(f"{name}\t{number}: is explained, but does not differ")
    print(f"{folder}: {files} files, {len(rows)} differences as explained, {found} others")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: counts.py PROGRAM FOLDER [--table]")
    sys.exit(main(sys.argv[1], sys.argv[2], "--table" in sys.argv[3:]))
