"""Every scene passes --check and begins with a comment."""

import runner

scenes = sorted((runner.ROOT / "parameters").rglob("*.prm"))
runner.check(len(scenes) >= 4, f"{len(scenes)} scenes")
for scene in scenes:
    status, _, error = runner.run("--check", scene)
    runner.check(status == 0, f"{scene.relative_to(runner.ROOT)}: {error}")
    runner.check(scene.read_text().startswith("# "), f"{scene.name} does not begin with a comment")
