"""Every scene passes --check and begins with a comment."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

scenes = sorted((runner.ROOT / "parameters").rglob("*.prm"))
runner.check(len(scenes) >= 4, f"{len(scenes)} scenes")
for scene in scenes:
    status, _, error = runner.run("--check", scene)
    runner.check(status == 0, f"{scene.relative_to(runner.ROOT)}: {error}")
    runner.check(scene.read_text().startswith("# "), f"{scene.name} does not begin with a comment")
