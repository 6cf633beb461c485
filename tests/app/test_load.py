"""A scene of many muscles and bones in small: loads, simulates and draws with its memory bounded. In full: docs/reliability.md."""
import json
import sys
import unittest

from program import PROGRAM, SANITIZED, SOURCE_DIR, ProgramTest

sys.path.insert(0, str(SOURCE_DIR / "tools"))
import load_scene  # noqa: E402


class LoadTest(ProgramTest):
    def test_a_scene_of_ten_muscles_and_six_bones(self):
        draws = self.run_program("render", "--help").returncode == 0
        steps, summary = load_scene.measure(PROGRAM, self.folder, muscles=10, bones=6,
                                            triangles=6_000 if SANITIZED else 60_000, frames=2 if SANITIZED else 4,
                                            limit_gb=0 if SANITIZED else 2.0, draws=draws)
        self.assertEqual((len(summary["muscles"]), len(summary["bones"])), (10, 6))
        self.assertEqual(summary["state"], "finished")
        attached = sum(len(muscle["attachments"]) == 2 for muscle in summary["muscles"])
        self.assertEqual(attached, 10, "the scene is not what it should be: " + json.dumps(summary["notes"]))
        if not SANITIZED:
            self.assertLess(max(step["peak_mb"] for step in steps), 700)


if __name__ == "__main__":
    unittest.main()
