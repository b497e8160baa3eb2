"""Pages of answers: those of the command, and in notebooks."""

import html
import json
import re

import maxwrench as mw
import pytest


def scene_of(page):
    """The scene in a page."""
    text = re.search(r'<script[^>]*id="scene"[^>]*>(.*?)</script>', page, re.DOTALL).group(1)
    return json.loads(text)


@pytest.mark.parametrize("name, budget", [("planar/force", 500), ("planar/trajectory", 50), ("dual_arm/bar_wall", 50)])
def test_it_is_the_page_of_the_command(command, name, budget):
    answer = mw.solve(name, budget=budget, seed=2)
    mine = answer.view().html
    theirs = command("view", name, "--budget", budget, "--seed", 2).stdout
    # The module may be built after the command.
    mine, theirs = (re.sub(r'"version":"[^"]*"', "", text) for text in (mine, theirs))
    assert mine == theirs


def test_the_virtual_tank_reads_what_simulate_reads():
    task = mw.load("mobile/trajectory")
    answer = mw.evaluate(task, task.theta_r_default)
    shown = scene_of(answer.view(tank=True).html)["shown"]
    run = mw.simulate(answer)
    assert shown[0]["tank"]["held"] == run.held
    assert shown[0]["tank"]["curve"]["reading"] == pytest.approx(list(run.readings), rel=1e-5)
    assert "tank" not in scene_of(answer.view().html)["shown"][0]
    with pytest.raises(mw.InputError, match="tank: got planar/force, a static task, expected a task in time"):
        mw.evaluate("planar/force", [0.3, -0.7]).view(tank=True)


def test_it_is_written_whole(tmp_path):
    file = tmp_path / "posture.html"
    page = mw.solve("planar/force", budget=200).view(file)
    assert file.read_text(encoding="utf-8") == page.html and list(tmp_path.iterdir()) == [file]
    page.save(tmp_path / "again.html")
    assert (tmp_path / "again.html").read_bytes() == file.read_bytes()
    with pytest.raises(OSError):
        page.save(tmp_path / "none" / "posture.html")


def test_a_notebook_shows_it():
    page = mw.solve("planar/force", budget=200).view()
    frame = page._repr_html_()
    assert frame.startswith("<iframe") and frame.endswith("</iframe>")
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', frame).group(1)) == page.html
    assert "planar/force" in repr(page) and "MB" in repr(page)


def test_pages_of_other_answers():
    task = mw.load("planar/force")
    shown = scene_of(mw.evaluate(task, [0.3, -0.7]).view().html)["shown"]
    assert [each["name"] for each in shown] == ["given", "default"]
    # One without a value is shown as far as it exists, and so are given joints and robots made in code.
    assert scene_of(mw.evaluate("uvms/valve", [0, 0, 0, 0]).view().html)["shown"]
    assert len(scene_of(mw.evaluate_joints("fixed/push", [0, 0.3, 0, -1.5, 0, -0.6, 0]).view().html)["shown"]) == 1
    boom = mw.Link("boom", 2, [0.5, 0, 0], [1e-3, 0.2, 0.2])
    crane = mw.make_robot(
        [mw.Link("stand"), boom],
        [mw.Joint("tilt", axis=[0, 1, 0], q_min=-1, q_max=1, effort_max=30)],
        end_effectors=[mw.EndEffector("hook", "boom", mw.Pose([1, 0, 0]))],
    )
    lift = mw.Static(crane, joints={"tilt": 0}, c="z")
    assert scene_of(mw.evaluate_joints(lift, [0.2]).view().html)["shown"]


def test_without_a_posture_there_is_no_page(rejects):
    nothing = mw.solve("uvms/lift_impulse", search="sample", budget=3)
    assert rejects(nothing.view).key == "answer"
