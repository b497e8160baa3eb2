"""Tables of notebooks."""

import re
import xml.etree.ElementTree as xml

import maxwrench as mw
import numpy as np
import pytest

IN_TIME = mw.load("planar/trajectory")
OBJECTS = {
    "answer": lambda: mw.solve("planar/force", budget=500),
    "answer without value": lambda: mw.evaluate("uvms/valve", [0, 0, 0, 0]),
    "answer in time": lambda: mw.evaluate(IN_TIME, IN_TIME.theta_r_default),
    "robot": lambda: mw.load("mobile/push").robot,
    "task": lambda: mw.load("uvms/valve"),
    "task in time": lambda: IN_TIME,
    "explanation": lambda: mw.solve("planar/force", budget=500).explain(),
    "explanation without value": lambda: mw.evaluate("uvms/valve", [0, 0, 0, 0]).explain(),
    "explanation in time": lambda: mw.evaluate(IN_TIME, IN_TIME.theta_r_default).explain(),
    "evaluations": lambda: mw.evaluate("planar/force", [[0, 0], [0.3, 0.1]]),
    "capability": lambda: mw.scale([[1, 1]], [-1, -1], [1, 1], [0], [4]),
    "capability of many": lambda: mw.capability(np.full((3, 6, 2), 0.5), np.zeros((3, 2)), [-2, -2], [2, 2], "x"),
    "capability without value": lambda: mw.capability(np.ones((6, 1)), [9], [-1], [1], "x"),
    "ellipsoid": lambda: mw.ellipsoid("planar/force", [0, 0], directions=np.eye(6)[:, :2]),
    "polytope": lambda: mw.polytope("planar/force", [0, 0], directions=np.eye(6)[:, :2]),
    "polytope of a point out of reach": lambda: mw.polytope("uvms/valve", [0, 0, 0, 0]),
    "program": lambda: mw.linprog([1, 2], [[1, 1]], [1]),
    "program without a point": lambda: mw.linprog([1], [[1]], [-1]),
    "evaluations without value": lambda: mw.evaluate("uvms/valve", [[0, 0, 0, 0]]),
}


def rows(html):
    return {row[0].text: row[1].text for row in xml.fromstring(html).iter("tr")}


@pytest.mark.parametrize("name", OBJECTS)
def test_tables_are_well_formed(name):
    table = rows(OBJECTS[name]()._repr_html_())
    assert table and all(table.values())


def test_contents():
    answer = OBJECTS["answer"]()
    table = rows(answer._repr_html_())
    assert float(table["beta"].split()[0]) == pytest.approx(answer.beta, rel=1e-5)
    assert table["status"] == answer.status and "u shoulder" in table
    table = rows(OBJECTS["evaluations without value"]()._repr_html_())
    assert table == {"with a value": "0 of 1 postures"}
    # One unit of effort each way: B u = 2 of the 4 that are demanded.
    table = rows(OBJECTS["capability"]()._repr_html_())
    assert float(table["beta"]) == 0.5 and table["u"] == "1, 1"
    # max x_1 + 2 x_2 on x_1 + x_2 = 1, x >= 0.
    table = rows(OBJECTS["program"]()._repr_html_())
    assert (table["objective"], table["x"]) == ("2", "0, 1")
    assert rows(OBJECTS["program without a point"]()._repr_html_())["status"] == "infeasible"
    ellipsoid = OBJECTS["ellipsoid"]()
    assert rows(ellipsoid._repr_html_())["radius 1"].startswith(f"{ellipsoid.radii[1]:.6g} along ")
    polytope = OBJECTS["polytope"]()
    low, high = rows(polytope._repr_html_())["direction 0"].split(" .. ")
    assert float(low) == pytest.approx(-float(high))  # the thrusters are symmetric


def test_texts_are_escaped(tmp_path):
    source = '<robot name="a&lt;b&gt;&amp;"><link name="base"/></robot>'
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(
        source.replace(
            '<link name="base"/>',
            '<link name="base"/><link name="tip"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1"'
            ' iyz="0" izz="1"/></inertial></link><joint name="j&lt;" type="revolute"><parent link="base"/><child link="tip"/>'
            '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="2" velocity="1"/></joint>',
        )
    )
    html = mw.Robot.from_urdf(urdf)._repr_html_()
    assert "joint j&lt;" in html and "a&lt;b&gt;&amp;" in html and not re.search(r"j<|a<b", html)
