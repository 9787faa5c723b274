"""claim    tools/check_rooms catches every way past rooms.txt, and lets a lawful tree pass
design   one small tree; each twin differs from it by one breach and must be caught, by file and line"""

import pathlib
import subprocess
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_rooms"
LAWFUL = {
    "rooms.txt": "# who may see whom\nbase:\nmodel: base\nfilter: base model\n",
    "mote/base/scan.hpp": "#include <vector>\n",
    "mote/model/ungm.hpp": '#include "mote/base/scan.hpp"\n#include "mote/model/model.hpp"\n',
    "mote/model/model.hpp": "// #include \"mote/filter/sisr.hpp\" is only a comment\n",
    "mote/filter/sisr.cpp": '#include "mote/base/scan.hpp"\n#  include <mote/model/ungm.hpp>\n',
}


class CheckRooms(unittest.TestCase):
    def run_on(self, changes, *options):
        with tempfile.TemporaryDirectory(prefix="mote rooms ") as folder:
            root = pathlib.Path(folder)
            for name, text in {**LAWFUL, **changes}.items():
                if text is None:
                    continue
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            done = subprocess.run([TOOL, root, *options], capture_output=True, text=True, check=False)
            return done.returncode, done.stderr

    def expect_breach(self, changes, sentence):
        code, said = self.run_on(changes)
        self.assertEqual((code, said), (1, sentence + "\n"))

    def test_a_lawful_tree_passes_in_silence(self):
        self.assertEqual(self.run_on({}), (0, ""))

    def test_a_header_that_includes_past_the_list_is_caught(self):
        self.expect_breach(
            {"mote/model/ungm.hpp": '#pragma once\n#include "mote/filter/sisr.hpp"\n'},
            "mote/model/ungm.hpp:2: includes mote/filter/sisr.hpp, but model may see base, not filter.",
        )

    def test_tests_benches_angle_brackets_and_subfolders_are_no_way_round(self):
        for name in ("mote/base/scan_test.cpp", "mote/base/scan_bench.cpp", "mote/base/deep/down.hpp"):
            self.expect_breach(
                {name: "#include <mote/model/ungm.hpp>\n"},
                f"{name}:1: includes mote/model/ungm.hpp, but base may see no other room, not model.",
            )

    def test_a_relative_path_is_no_way_round(self):
        self.expect_breach(
            {"mote/base/scan.cpp": '#include "../model/ungm.hpp"\n'},
            "mote/base/scan.cpp:1: includes ../model/ungm.hpp, but base may see no other room, not model.",
        )

    def test_a_missing_folder_is_caught(self):
        self.expect_breach(
            {"rooms.txt": LAWFUL["rooms.txt"] + "cluster: base\n"},
            "rooms.txt:5: room cluster: expected the folder mote/cluster/, got none. Create it or drop the line.",
        )

    def test_a_folder_that_is_no_room_is_caught(self):
        self.expect_breach(
            {"mote/attic/old.hpp": ""},
            'mote/attic/: expected a line in rooms.txt, got none. Add "attic: <rooms it may see>".',
        )

    def test_a_circle_of_rooms_is_caught(self):
        self.expect_breach(
            {"rooms.txt": "base: filter\nmodel: base\nfilter: base model\n"},
            "rooms.txt:1: rooms see each other in a circle: base -> filter -> base. Break it.",
        )

    def test_a_malformed_list_is_caught(self):
        self.expect_breach(
            {"rooms.txt": LAWFUL["rooms.txt"] + "engine\n"},
            'rooms.txt:5: expected "room: rooms it may see", got "engine".',
        )
        self.expect_breach(
            {"rooms.txt": LAWFUL["rooms.txt"].replace("model: base", "model: base graph")},
            "rooms.txt:3: room model may see graph, but no line describes graph. Add it or correct the name.",
        )

    def test_the_stamp_appears_only_for_a_lawful_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            stamp, depfile = pathlib.Path(folder, "stamp"), pathlib.Path(folder, "depfile")
            options = ("--stamp", stamp, "--depfile", depfile)
            self.run_on({"mote/attic/old.hpp": ""}, *options)
            self.assertFalse(stamp.exists())
            self.run_on({}, *options)
            self.assertTrue(stamp.exists())
            self.assertIn("mote/filter/sisr.cpp", depfile.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
