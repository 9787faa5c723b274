"""claim    tools/lint catches a badly laid out file and a badly named thing, and lets lawful ones pass
design   a tree of one file with this project's own settings; the twins differ by a space and by one capital letter"""

import importlib.machinery
import importlib.util
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAWFUL = "int twice(int number) { return kTwo * number; }\n"  # kTwo comes from the precompiled header


def lint_module():
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("lint", str(ROOT / "tools" / "lint"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("lint", loader))
    loader.exec_module(module)
    return module


def lint(what, text):
    """Exit code and output of tools/lint on a tree that holds mote/base/one.cpp with this text."""
    with tempfile.TemporaryDirectory(prefix="mote lint ") as folder:
        root = pathlib.Path(folder)
        for name in ("tools/lint", ".clang-format", ".clang-tidy"):
            (root / name).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / name, root / name)
        source = root / "mote" / "base" / "one.cpp"
        source.parent.mkdir(parents=True)
        source.write_text(text, encoding="utf-8")
        (root / "build").mkdir()
        (root / "cmake_pch.hxx").write_text("constexpr int kTwo = 2;\n", encoding="utf-8")
        (root / "cmake_pch.hxx.gch").write_bytes(b"gpch.013")
        command = ["g++", "-std=c++20", "-Winvalid-pch", "-include", str(root / "cmake_pch.hxx"), "-march=native", "-c", str(source)]
        entry = {"directory": str(root), "file": str(source), "arguments": command}
        (root / "build" / "compile_commands.json").write_text(json.dumps([entry]), encoding="utf-8")
        done = subprocess.run([root / "tools" / "lint", what], capture_output=True, text=True, check=False, cwd="/")
        return done.returncode, done.stdout + done.stderr


class Lint(unittest.TestCase):
    def test_format(self):
        self.assertEqual(lint("format", LAWFUL), (0, ""))
        code, said = lint("format", LAWFUL.replace("kTwo *", "kTwo  *"))
        self.assertEqual(code, 1)
        self.assertIn("one.cpp:1", said)

    @unittest.skipUnless(shutil.which("clang-tidy"), "clang-tidy is not installed")
    def test_tidy(self):
        code, said = lint("tidy", LAWFUL)
        self.assertEqual(code, 0, said)
        code, said = lint("tidy", LAWFUL.replace("twice", "Twice"))
        self.assertEqual(code, 1)
        self.assertIn("readability-identifier-naming", said)

    def test_a_command_of_gcc_becomes_one_of_clang(self):
        with tempfile.TemporaryDirectory() as folder:
            header = pathlib.Path(folder, "cmake_pch.hxx")
            header.write_text("#include <vector>\n", encoding="utf-8")
            command = f"g++ -I/x -O3 -Wall -Winvalid-pch -include {header} -march=native -std=c++20 -c a.cpp".split()
            kept = lint_module().for_clang(command, pathlib.Path(folder, "lint"))
            copy = pathlib.Path(kept.pop(kept.index("-include") + 1))
            self.assertEqual(kept, "g++ -I/x -O3 -include -march=native -std=c++20 -c a.cpp".split())
            self.assertNotEqual(copy, header)
            self.assertEqual(copy.read_text(encoding="utf-8"), "#include <vector>\n")

    def test_wrong_use_is_refused(self):
        done = subprocess.run([ROOT / "tools" / "lint", "tidy", "no/such/file.cpp"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected a file or folder", done.stderr)


if __name__ == "__main__":
    unittest.main()
