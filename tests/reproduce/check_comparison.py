"""python3 check_comparison.py FOLDER [--all-hold]: judges what `mote reproduce` left in FOLDER.

comparison.json has the fixed fields with fixed types, a ratio exactly where a number is printed, and a CSV beside it for every item.
"""

import json
import math
import pathlib
import sys

FIELDS = {"item": str, "paper": (str, float, int, type(None)), "ours": (float, int, type(None)),
          "ratio": (float, int, type(None)), "holds": bool, "note": str}


def number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def faults_of(entry):
    if set(entry) != set(FIELDS):
        return [f"fields {sorted(entry)}"]
    faults = [f"{key} is {entry[key]!r}" for key, kind in FIELDS.items() if not isinstance(entry[key], kind)]
    if number(entry["paper"]) and number(entry["ours"]):
        ratio = entry["ours"] / entry["paper"]
        if not number(entry["ratio"]) or not math.isclose(entry["ratio"], ratio, rel_tol=1e-9):
            faults.append(f"ratio is {entry['ratio']!r}, expected {ratio}")
    elif entry["ratio"] is not None:
        faults.append("a ratio without a printed number")
    if entry["holds"] and entry["ours"] is None:
        faults.append("holds without a number of ours")
    if "holds when" not in entry["note"]:
        faults.append("the note does not say when it holds")
    return faults


def slug(text):
    return "-".join("".join(c if c.isalnum() else " " for c in text.lower()).split())


def main(folder, all_hold):
    entries = json.loads((folder / "comparison.json").read_text())
    page = (folder / "index.html").read_text()
    faults = [] if entries else ["no comparison"]
    for entry in entries:
        own = faults_of(entry)
        if all_hold and not own and not entry["holds"]:
            own.append(f"does not hold: {entry['ours']}; {entry['note']}")
        item = entry["item"].split(":")[0]
        if not (folder / f"{slug(item)}.csv").is_file():
            own.append(f"no {slug(item)}.csv")
        if item not in page:
            own.append("not in index.html")
        faults += [f"{entry['item']}: {fault}" for fault in own]
    for fault in faults:
        print(f"check_comparison: {folder.name}: {fault}", file=sys.stderr)
    print(f"{folder.name}: {len(entries)} comparisons, {sum(e['holds'] for e in entries)} hold, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main(pathlib.Path(sys.argv[1]), "--all-hold" in sys.argv[2:]))
