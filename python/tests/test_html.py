"""Tables of notebooks."""

import re
import xml.etree.ElementTree as xml

import maxwrench as mw
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
