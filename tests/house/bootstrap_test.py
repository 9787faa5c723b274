"""claim    tools/bootstrap asks apt-get once, only for what is missing, and refuses in one sentence when it may not
design   a PATH of stand-ins for dpkg-query, id, sudo, apt-get, node and npm that write down how they were called"""

import os
import pathlib
import subprocess
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bootstrap"
PACKAGES = """# group name why
build  g++     compiles
build  nodejs  bundles
build  npm     fetches
test   libx    tests
lint   liby    lints
"""


class Bootstrap(unittest.TestCase):
    def run_with(self, group, installed=(), uid="0", sudo=False, node="v20.1.0", apt="exit 0"):
        """(exit code, output, how apt-get was called) on a machine with these packages."""
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)
            (here / "packages.txt").write_text(PACKAGES, encoding="utf-8")
            calls = here / "calls"
            known = "|".join(installed) or "none"
            stand_ins = {
                "dpkg-query": f'for last; do :; done; case "$last" in {known}) printf installed ;; *) exit 1 ;; esac',
                "id": f"echo {uid}",
                "sudo": 'shift; exec "$@"' if sudo else "exit 1",
                "apt-get": f'echo "$DEBIAN_FRONTEND apt-get $*" >>{calls}; {apt}',
                "node": f"echo {node}" if node else "exit 127",
                "npm": "echo 9.2.0" if node else "exit 127",
            }
            for name, body in stand_ins.items():
                (here / name).write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
                (here / name).chmod(0o755)
            environment = {"PATH": f"{here}:/usr/bin:/bin", "MOTE_PACKAGES": str(here / "packages.txt"), "HOME": os.environ.get("HOME", "/")}
            done = subprocess.run(
                [TOOL, *group], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
            )
            return done.returncode, done.stdout + done.stderr, calls.read_text(encoding="utf-8") if calls.exists() else ""

    def test_a_complete_machine_is_left_alone(self):
        code, said, calls = self.run_with(["check"], installed=["g++", "libx"])
        self.assertEqual((code, calls), (0, ""))
        self.assertIn("all 4 packages for 'check' are there", said)

    def test_root_installs_what_is_missing_by_one_update_and_one_install(self):
        code, said, calls = self.run_with(["all"], installed=["g++"])
        self.assertEqual(code, 0, said)
        self.assertEqual(
            calls,
            "noninteractive apt-get update -q\nnoninteractive apt-get install -q -y --no-install-recommends libx liby\n",
        )

    def test_groups_hold_what_they_should(self):
        for group, missing in (("build", ""), ("check", "libx"), ("all", "libx liby")):
            calls = self.run_with([group], installed=["g++"])[2]
            self.assertEqual(calls.partition("recommends ")[2].strip(), missing)

    def test_node_from_elsewhere_counts_unless_it_is_too_old(self):
        self.assertEqual(self.run_with(["build"], installed=["g++"])[2], "")
        self.assertIn("nodejs", self.run_with(["build"], installed=["g++"], node="v16.0.0")[2])
        self.assertIn("nodejs npm", self.run_with(["build"], installed=["g++"], node=None)[2])

    def test_sudo_without_password_serves(self):
        self.assertEqual(self.run_with(["check"], installed=["g++"], uid="1000", sudo=True)[0], 0)

    def test_without_rights_the_command_to_run_is_told(self):
        code, said, calls = self.run_with(["check"], installed=["g++"], uid="1000")
        self.assertEqual((code, calls), (5, ""))
        self.assertIn("Run as root: apt-get update -q && apt-get install -q -y --no-install-recommends libx\n", said)

    def test_a_failing_apt_is_told(self):
        code, said, _ = self.run_with(["check"], installed=["g++"], apt="exit 100")
        self.assertEqual(code, 5)
        self.assertIn("apt-get failed", said)

    def test_wrong_use_is_refused(self):
        for group in ([], ["everything"]):
            self.assertEqual(self.run_with(group)[0], 2)


if __name__ == "__main__":
    unittest.main()
