"""claim    ./check fails when any step fails, ends with ctest's summary and one line, needs no terminal and no current folder
design   a tree with ./check, its shared lines and stand-ins for every tool it calls; each twin breaks one of them"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUMMARY = "100% tests passed, 0 tests failed out of 3"


class Check(unittest.TestCase):
    def run_check(self, *options, broken="", script="check"):
        """(exit code, lines, calls) of ./check where the command named `broken` fails."""
        with tempfile.TemporaryDirectory(prefix="mote check ") as folder:
            root, bin_ = pathlib.Path(folder, "tree"), pathlib.Path(folder, "bin")
            for name in ("check", ".ci/run", "tools/house.sh"):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, root / name)
            bin_.mkdir()
            calls = pathlib.Path(folder, "calls")
            for place, name in ((root / "tools", "bootstrap"), (root / "tools", "lint"), (root / "tools", "fuzz"), (bin_, "cmake"), (bin_, "ctest")):
                says = f'echo "{SUMMARY}"' if name == "ctest" else ":"
                body = f'call="{name} $*"; echo "$call" >>"{calls}"; cat; {says}; case "$call" in {broken or "nothing"}*) exit 1 ;; esac'
                (place / name).write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
                (place / name).chmod(0o755)
            environment = {**os.environ, "PATH": f"{bin_}:/usr/bin:/bin"}
            done = subprocess.run(
                [root / script, *options], env=environment, input="typed\n", cwd="/", capture_output=True, text=True, check=False
            )
            self.assertNotIn("typed", done.stdout, "a step read from the terminal")
            log = root / "build" / "check.log"
            self.assertEqual(log.exists(), done.returncode != 2 and "--help" not in options)
            if log.exists():
                self.assertEqual(log.read_text(encoding="utf-8"), done.stdout)
            called = [re.sub(r" -j \d+( --output-on-failure)?( --no-tests=error)?", "", line) for line in calls.read_text(encoding="utf-8").splitlines()] if calls.exists() else []
            return done.returncode, [line for line in done.stdout.splitlines() if line], called

    def test_passes_and_ends_with_the_summary_and_one_line(self):
        for script in ("check", ".ci/run"):
            code, lines, calls = self.run_check(script=script)
            self.assertEqual(code, 0)
            self.assertEqual(lines[-2], SUMMARY)
            self.assertRegex(lines[-1], r"^check: passed in 0 min \d\d s: packages, configure, build, tests\. Log: .*/build/check\.log$")
            self.assertEqual(calls, ["bootstrap check", "cmake --preset release", "cmake --build --preset release", "ctest --preset release"])

    def test_every_failing_step_fails_the_whole(self):
        for broken, name in (("bootstrap", "packages"), ("'cmake --preset'", "configure"), ("'cmake --build'", "build"), ("ctest", "tests")):
            code, lines, _ = self.run_check(broken=broken)
            self.assertEqual(code, 1, broken)
            self.assertRegex(lines[-1], rf"^check: FAILED after 0 min \d\d s: {name}\. Look in ")

    def test_nothing_is_tested_that_was_not_built(self):
        self.assertEqual(self.run_check(broken="'cmake --build'")[2][-1], "cmake --build --preset release")

    def test_all_adds_its_steps_before_the_tests(self):
        code, lines, calls = self.run_check("--all")
        self.assertEqual(code, 0)
        self.assertEqual(calls[0], "bootstrap all")
        self.assertEqual(
            calls[3:-1],
            [
                "lint tidy", "cmake --preset asan", "cmake --build --preset asan", "ctest --preset asan",
                "cmake --preset tsan", "cmake --build --preset tsan --target software_tests", r"ctest --preset tsan -R ^software_tests\.", "fuzz 20",
            ],
        )
        self.assertTrue(calls[-1].startswith("ctest --test-dir"), "all labels, nightly ones too")
        self.assertEqual(lines[-2], SUMMARY)
        for broken, name in (("lint", "clang-tidy"), ("'cmake --build --preset asan'", "sanitizers"), ("'ctest --preset tsan'", "thread sanitizer"), ("fuzz", "fuzzing")):
            code, lines, calls = self.run_check("--all", broken=broken)
            self.assertEqual(code, 1)
            self.assertIn(f": {name}. Look in", lines[-1])
            self.assertTrue(calls[-1].startswith("ctest --test-dir"), "the tests run nevertheless")

    def test_fast_installs_nothing_and_leaves_slow_tests_out(self):
        code, _, calls = self.run_check("--fast")
        self.assertEqual(code, 0)
        self.assertEqual(calls[0], "cmake --preset release")
        self.assertRegex(calls[-1], r"^ctest --test-dir .* -LE nightly\|slow$")

    def test_wrong_use_is_refused(self):
        self.assertEqual(self.run_check("--quick")[0], 2)
        self.assertEqual(self.run_check("--help")[0], 0)


if __name__ == "__main__":
    unittest.main()
