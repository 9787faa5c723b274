"""claim    docs.py catches a document that lies, and lets a true one pass
design   small documents; each twin differs from a true one by one lie and must be caught, by file and line"""

import json
import pathlib
import subprocess
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parent / "docs.py"
RUN = "# Title\n\n```sh\n# run\necho one\necho took 5 ms\n```\n\n```text\none\ntook ... ms\n```\n"
FILTERS = "# Filters\n\n```\n(F1)  x\n(F2)  y\n```\n\nsee (F1)\n"
MODEL = {
    "columns": ["y"],
    "parameters": [{"name": "a", "default": "0.5", "unit": "", "meaning": "gain", "allowed": "any"}],
    "proposals": [{"name": "prior", "meaning": "itself"}],
    "states": [{"name": "x", "unit": "m"}],
}


class Docs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="mote docs ")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def program(self, text):
        path = self.write("program", "#!/bin/sh\n" + text)
        path.chmod(0o755)
        return path

    def tool(self, *words):
        done = subprocess.run([TOOL, *words], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def expect(self, answer, code, sentence=""):
        self.assertEqual(answer[0], code, answer[1])
        self.assertIn(sentence, answer[1])

    def run_document(self, text):
        return self.tool("run", self.write("page.md", text), self.program("echo mote says $1"))

    def test_true_commands_pass(self):
        self.expect(self.run_document(RUN), 0)
        self.expect(self.run_document("```sh\n# run\nmote hello\n```\n\n```text\nmote says hello\n```\n"), 0)
        self.expect(self.run_document("```sh\n# run, exit 3\nexit 3\n```\n"), 0)
        self.expect(self.run_document("```sh\nrm -rf only-shown\nfalse\n```\n"), 0)

    def test_a_line_that_is_not_printed_is_caught(self):
        self.expect(self.run_document(RUN.replace("\none\n", "\ntwo\n")), 1, 'page.md:9: expected the printed line "two"')

    def test_output_that_nothing_checks_is_caught(self):
        self.expect(self.run_document(RUN.replace("\n\n```text", "\n\nIt prints:\n\n```text")), 1, "page.md:11: shows output, but")
        self.expect(self.run_document("```sh\nmote hello\n```\n\n```text\nmote says bye\n```\n"), 1, "page.md:5: shows output, but")

    def test_lines_in_another_order_are_caught(self):
        self.expect(self.run_document(RUN.replace("one\ntook ... ms", "took ... ms\none")), 1, 'line "one"')

    def test_another_exit_code_is_caught(self):
        self.expect(self.run_document("```sh\n# run\nfalse\n```\n"), 1, "page.md:1: expected exit code 0, got 1")
        self.expect(self.run_document("```sh\n# run, exit 3\nexit 2\n```\n"), 1, "expected exit code 3, got 2")

    def test_a_command_that_fails_midway_is_caught(self):
        self.expect(self.run_document("```sh\n# run\nfalse\ntrue\n```\n"), 1, "expected exit code 0, got 1")

    def test_programs_are_extracted_and_compared(self):
        page = self.write("page.md", "```cpp\n// example: p\nint main() {}\n```\n\n```text\nhello\n```\n\n```cpp\nint shown_only;\n```\n")
        self.assertEqual(self.tool("extract", self.root / "out", page), (0, f"{page.resolve()}|p\n"))
        self.assertEqual((self.root / "out/p.cpp").read_text(), "// example: p\nint main() {}\n")
        self.expect(self.tool("example", page, "p", self.program("echo hello")), 0)
        self.expect(self.tool("example", page, "p", self.program("echo goodbye")), 1, 'line "hello"')

    def test_a_stale_listing_is_caught(self):
        self.write("code.hpp", "int a;\nint b;\n")
        page = self.write("page.md", "<!-- file: code.hpp -->\n```cpp\nint b;\n```\n")
        self.expect(self.tool("listings", self.root, page), 0)
        self.write("code.hpp", "int a;\nint c;\n")
        self.expect(self.tool("listings", self.root, page), 1, "page.md:2: differs from code.hpp")

    def test_a_stale_table_is_caught_and_rewritten(self):
        answer = json.dumps(MODEL)
        mote = self.program(f"if [ \"$3\" ]; then echo '{answer}'; else echo 'm  a model'; fi\n")
        page = self.write("models.md", "<!-- parameters: m -->\n<!-- end -->\n")
        self.expect(self.tool("models", page, mote), 1, "a table of parameters is not what mote models says")
        self.expect(self.tool("models", page, mote, "--write"), 0)
        self.expect(self.tool("models", page, mote), 0)
        self.assertIn("| `a` | 0.5 |  | gain (any) |", page.read_text())
        page.write_text(page.read_text().replace("0.5", "0.6"))
        self.expect(self.tool("models", page, mote), 1)
        page.write_text("no table\n")
        self.expect(self.tool("models", page, mote), 1, "the model m has no table")

    def references(self, **files):
        self.write("docs/filters.md", FILTERS)
        for name, text in files.items():
            self.write(name.replace("__", "/").replace("_DOT_", "."), text)
        return self.tool("references", self.root)

    def test_true_references_pass(self):
        self.expect(self.references(README_DOT_md="[f](docs/filters.md#filters) [out](https://example.org)\n",
                                    a_DOT_hpp="/// source  docs/filters.md (F1), (F2); docs/filters.md\n"), 0)

    def test_broken_links_are_caught(self):
        self.expect(self.references(README_DOT_md="[f](docs/nothing.md)\n"), 1, "README.md: the link to docs/nothing.md leads nowhere")
        self.expect(self.references(README_DOT_md="[f](docs/filters.md#gone)\n"), 1, "has no heading #gone")

    def test_unknown_equations_are_caught(self):
        self.expect(self.references(a_DOT_hpp="/// source  docs/filters.md (F1),\n///         (F9)\n"), 1, "a.hpp: cites (F9)")
        self.expect(self.references(docs__other_DOT_md="by (F7)\n"), 1, "docs/other.md: cites (F7)")
        self.expect(self.references(a_DOT_hpp="/// source  docs/filters.md (F1) to (F2a)\n"), 1, "a.hpp: cites (F2a)")

    def test_a_document_that_is_not_there_is_caught(self):
        self.expect(self.references(a_DOT_hpp="// see docs/gone.md\n"), 1, "a.hpp: names docs/gone.md, which is not there")

    def test_equations_out_of_order_are_caught(self):
        self.write("docs/filters.md", FILTERS.replace("(F2)", "(F3)"))
        self.expect(self.tool("references", self.root), 1, "in order, got [1, 3]")


if __name__ == "__main__":
    unittest.main()
