#!/usr/bin/env python3
"""Holds the documents to what they claim: their programs compile and print what is shown, their commands run, their tables,
listings and references are true.

    docs.py extract OUT_DIR FILE.md...            writes OUT_DIR/<name>.cpp for every program, prints the names
    docs.py example FILE.md NAME PROGRAM          runs a compiled program, compares what it prints
    docs.py run FILE.md MOTE [DATA_DIR]           runs the commands in a folder of their own, `mote` is MOTE, data/ is DATA_DIR
    docs.py listings ROOT FILE.md...              every listing stands in the file that it names
    docs.py models FILE.md MOTE [--write]         the tables of parameters are those of `mote models NAME --json`
    docs.py references ROOT                       links lead to files and headings; equations cited in code exist

Conventions of the documents:
    ```cpp      with the first line `// example: NAME` is a whole program
    ```sh       with the first line `# run` is run by bash; `# run, exit 3` must end with that code
    ```text     right after either (blank lines between) holds lines that are printed in this order; `...` stands for anything
                (elsewhere it is refused: nothing would check it)
    <!-- file: PATH -->     before a block: the block stands in that file, word for word
    <!-- parameters: NAME --> ... <!-- end -->    holds the generated table of a model
    (F7)        at the beginning of a line of a plain block in docs/filters.md is an equation (and (F7a) one that follows it); code cites "docs/filters.md (F7)"

Exit code 0: all holds; 1: a sentence for each thing that does not; 2: wrong use.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass

LISTED = re.compile(r"<!-- file: (\S+) -->")
TABLE = re.compile(r"(<!-- parameters: (\S+) -->\n).*?(<!-- end -->)", re.S)
LINK = re.compile(r"(?<!`)!?\[[^\]]*\]\(([^)\s]+)\)")
CODE = (".cpp", ".hpp", ".py", ".js", ".mjs", ".cmake", ".txt", ".md", ".toml", "")
EQUATION = re.compile(r"\(F(\d+)([a-z]?)\)")
CITED = re.compile(r"docs/filters\.md((?:,?\s*\(F\d+[a-z]?\)(?:\s*(?:-|–|to|and)\s*\(F\d+[a-z]?\))*)+)")


@dataclass
class Block:
    """A fenced block: where it begins, its language, its lines, what the comment before it names, and the block after it."""
    where: str
    language: str
    lines: list
    listed: str = ""
    shown: "Block" = None

    @property
    def first(self):
        return self.lines[0].strip() if self.lines else ""


def blocks_of(path):
    found, current, fence, listed, near = [], None, "", "", None
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        stripped = line.strip()
        if current is not None:
            if stripped == fence:
                if near is not None and current.language == "text":
                    near.shown = current
                found.append(current)
                near, current, listed = current, None, ""
            else:
                current.lines.append(line)
        elif match := re.match(r"(`{3,})(\w*)$", stripped):
            fence = match[1]
            current = Block(f"{path.name}:{number}", match[2], [], listed)
        elif match := LISTED.match(stripped):
            listed = match[1]
        elif stripped:
            near = None
    if current is not None:
        raise SystemExit(f"{current.where}: a block that never ends.")
    return found


def examples_of(path):
    return {m[1]: b for b in blocks_of(path) if b.language == "cpp" and (m := re.match(r"// example: (\w+)$", b.first))}


def missing_lines(block, printed):
    """The lines a block shows that are not printed in that order."""
    if block.shown is None:
        return []
    rest, missing = iter(printed.splitlines()), []
    for line in block.shown.lines:
        if line.strip() in ("", "..."):
            continue
        pattern = re.compile(".*".join(re.escape(part) for part in line.rstrip().split("...")))
        if not any(pattern.fullmatch(other.rstrip()) for other in rest):
            missing.append(f'{block.shown.where}: expected the printed line "{line}", got no such line there.')
            break
    return missing


def judged(block, done, code):
    faults = []
    if done.returncode != code:
        faults.append(f"{block.where}: expected exit code {code}, got {done.returncode}.")
    faults += missing_lines(block, done.stdout)
    if faults:
        faults.append("It printed:\n" + done.stdout)
    return faults


def started(command, folder, path=""):
    environment = {**os.environ, "PATH": path + os.environ["PATH"], "LC_ALL": "C.UTF-8"}
    return subprocess.run(command, cwd=folder, env=environment, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=300, check=False)


def extract(out, *files):
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    for file in files:
        for name, block in examples_of(pathlib.Path(file)).items():
            text = "\n".join(block.lines) + "\n"
            target = out / f"{name}.cpp"
            if not target.exists() or target.read_text(encoding="utf-8") != text:
                target.write_text(text, encoding="utf-8")
            print(f"{pathlib.Path(file).resolve()}|{name}")
    return []


def example(file, name, program):
    block = examples_of(pathlib.Path(file))[name]
    with tempfile.TemporaryDirectory() as folder:
        return judged(block, started([program], folder), 0)


def unchecked(blocks):
    """Shown output that follows no program and no command that is run: nothing would hold it to the truth."""
    judged_blocks = [b.shown for b in blocks if b.shown and re.match(r"// example: \w+$|# run(?:, exit \d+)?$", b.first)]
    return [f"{b.where}: shows output, but no program or command that is run stands right before it."
            for b in blocks if b.language == "text" and not any(b is other for other in judged_blocks)]


def run(file, mote, data=""):
    faults = unchecked(blocks_of(pathlib.Path(file)))
    with tempfile.TemporaryDirectory() as folder:
        programs = pathlib.Path(folder, ".programs")
        programs.mkdir()
        (programs / "mote").symlink_to(pathlib.Path(mote).resolve())
        if data:
            pathlib.Path(folder, "data").symlink_to(pathlib.Path(data).resolve())
        for block in blocks_of(pathlib.Path(file)):
            match = re.match(r"# run(?:, exit (\d+))?$", block.first)
            if block.language != "sh" or not match:
                continue
            script = "\n".join(block.lines)
            faults += judged(block, started(["bash", "-euo", "pipefail", "-c", script], folder, f"{programs}:"), int(match[1] or 0))
    return faults


def listings(root, *files):
    faults = []
    for block in (b for file in files for b in blocks_of(pathlib.Path(file)) if b.listed):
        path = pathlib.Path(root, block.listed)
        if not path.is_file():
            faults.append(f"{block.where}: names the file {block.listed}, which is not there.")
        elif "\n".join(block.lines) not in path.read_text(encoding="utf-8"):
            faults.append(f"{block.where}: differs from {block.listed}. Copy one to the other.")
    return faults


def table_of(name, mote):
    model = json.loads(subprocess.run([mote, "models", name, "--json"], capture_output=True, text=True, check=True).stdout)
    lines = ["| parameter | default | unit | meaning |", "|---|---|---|---|"]
    for p in model["parameters"]:
        lines.append(f"| `{p['name']}` | {p['default'] or '–'} | {p['unit']} | {p['meaning']} ({p['allowed']}) |")
    names = ", ".join("`" + s["name"] + "`" + (f" ({s['unit']})" if s["unit"] else "") for s in model["states"])
    columns = ", ".join(f"`{c}`" for c in model["columns"])
    proposals = "; ".join(f"`{p['name']}`: {p['meaning']}" for p in model["proposals"])
    return "\n".join(lines) + f"\n\nStates: {names}. Data columns: `t`, {columns}. Proposals: {proposals}.\n"


def models(file, mote, write=""):
    path = pathlib.Path(file)
    text = path.read_text(encoding="utf-8")
    listed = subprocess.run([mote, "models"], capture_output=True, text=True, check=True).stdout.splitlines()
    known = {line.split()[0] for line in listed if line and not line.startswith("mote models")}
    faults = [f"{path.name}: the model {name} has no table of parameters." for name in sorted(known - {m[2] for m in TABLE.finditer(text)})]
    fresh = TABLE.sub(lambda m: m[1] + table_of(m[2], mote) + m[3], text)
    if write == "--write":
        path.write_text(fresh, encoding="utf-8")
    elif fresh != text:
        faults.append(f"{path.name}: a table of parameters is not what mote models says. Run docs.py models {path.name} MOTE --write.")
    return faults


def tracked(root):
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True, check=False)
    if listed.returncode == 0:
        names = [name for name in listed.stdout.split("\0") if name]
    else:
        names = [str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()]
    outside = {"build", "node_modules", ".git"}
    return [pathlib.Path(root, n) for n in names if not outside & set(pathlib.Path(n).parts) and pathlib.Path(root, n).is_file()]


def anchors_of(path):
    prose = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.S | re.M)
    return {re.sub(r"[^\w\- ]", "", h.lower()).strip().replace(" ", "-") for h in re.findall(r"^#+ (.+)$", prose, re.M)}


def broken_links(root, path):
    prose = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.S | re.M)
    for target in LINK.findall(prose):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, heading = target.partition("#")
        to = (path.parent / file).resolve() if file else path
        if not to.exists() or not to.is_relative_to(root):
            yield f"{path.relative_to(root)}: the link to {target} leads nowhere."
        elif heading and to.suffix == ".md" and heading not in anchors_of(to):
            yield f"{path.relative_to(root)}: {file or path.name} has no heading #{heading}."


def references(root):
    root = pathlib.Path(root).resolve()
    plain = [b for b in blocks_of(root / "docs/filters.md") if not b.language]
    equations = [m for b in plain for line in b.lines if (m := EQUATION.match(line))]
    numbers = [int(m[1]) for m in equations if not m[2]]
    known = {m[1] + m[2] for m in equations}
    faults = []
    if numbers != list(range(1, len(numbers) + 1)):
        faults.append(f"docs/filters.md: expected the equations (F1), (F2), ... in order, got {numbers}.")
    for path in tracked(root):
        if path.suffix not in CODE or path.is_relative_to(root / "tests/docs"):
            continue
        text = path.read_text(encoding="utf-8", errors="replace")
        name = path.relative_to(root)
        if path.suffix == ".md":
            faults += broken_links(root, path)
        joined = re.sub(r"\n\s*(?:///|//|#|\*)? ?", " ", text)
        cited = [n for group in CITED.findall(joined) for n in re.findall(r"F(\d+[a-z]?)", group)]
        if path.is_relative_to(root / "docs"):
            cited += re.findall(r"\(F(\d+[a-z]?)\)", text)
        faults += [f"{name}: cites (F{n}), which docs/filters.md does not have." for n in sorted(set(cited) - known)]
        for document in sorted(set(re.findall(r"(?<![\w/.])docs/[\w./-]+\.md", text))):
            if not (root / document).is_file():
                faults.append(f"{name}: names {document}, which is not there.")
    return faults


def main(words):
    commands = {f.__name__: f for f in (extract, example, run, listings, models, references)}
    if not words or words[0] not in commands:
        print(__doc__, file=sys.stderr)
        return 2
    faults = commands[words[0]](*words[1:])
    for sentence in faults:
        print(sentence)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
