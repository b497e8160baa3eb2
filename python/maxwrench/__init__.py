"""How strongly a redundant robot can push, lift or twist, in which posture and with which efforts.

A short tour; docs/python.md is a longer one.

>>> task = maxwrench.load("uvms/valve")                 # a shipped task, or a task file
>>> answer = maxwrench.solve(task, budget=8000)         # the best posture
>>> print(round(answer.beta, 1), answer.unit)
35.4 N m
>>> many = maxwrench.evaluate(task, [answer.theta_r, task.theta_r_default])  # postures side by side
>>> many.beta.shape, many.u.shape
((2,), (2, 12))

``Robot.from_urdf`` and ``make_robot`` make other robots, ``Static`` makes tasks of them, ``Trajectory`` and ``Impulse`` tasks in
time; ``simulate`` carries an answer out in the virtual tank. ``capability``, ``scale`` and ``linprog``
take plain arrays, of any model. ``measures``, ``solvers`` and ``searches`` list the choices. Wrong
arguments and files raise ``InputError``.

Units are SI: m, rad, N, N m, s. A wrench is [force; torque] that the robot exerts at the end effector,
in the axes of the world; ``moved``, ``to_pinocchio`` and ``to_drake`` change point, axes and order.
"""

from . import _arguments, _core, _dict, _frames, _html, _made, _map, _plot, _view
from ._core import *  # noqa: F401,F403
from ._core import Answer, Capability, Ellipsoid, Evaluations, Experiment, Explanation, Limit, Loss, LpAnswer, Map, Path, Polytope
from ._core import HeldTrajectory, Pose, Posture, Robot, Task, TrajectoryProof, VerifiedProof, VerifiedTrajectory
from ._core import __version__
from ._frames import from_drake, from_pinocchio, moved, to_drake, to_pinocchio
from ._errors import SearchEnded
from ._parts import Contact, Direction, EndEffector, Gear, Hydrodynamics, Joint, Link, Shape, Thruster
from ._progress import progress
from ._race import race
from ._ros import joint_state, joint_trajectory, to_yaml, wrench_stamped
from ._strategies import Measure, Search, add_measure, add_search
from ._table import table
from ._view import Page

for _name, _function in list(vars(_core).items()):
    if not _name.startswith("_") and not isinstance(_function, type) and callable(_function):
        globals()[_name] = _arguments.checked(_function)
_arguments.check_class(Answer, methods=["explain", "sample"])
_arguments.check_class(Pose, methods=["__init__"], static=["from_matrix"])
_arguments.check_class(Path, methods=["at"], static=["spline", "screw"])
_arguments.check_class(Robot, static=["from_urdf", "from_toml"])
_arguments.check_class(Task, methods=["with_limits"])

for _result in (
    Capability,
    Ellipsoid,
    Evaluations,
    Experiment,
    HeldTrajectory,
    Limit,
    Loss,
    LpAnswer,
    Polytope,
    Posture,
    TrajectoryProof,
    VerifiedProof,
    VerifiedTrajectory,
):
    setattr(_result, "to_dict", _dict.dict_of)
for _made_again in (Path, Pose, Robot, Task):
    setattr(_made_again, "to_dict", _made.dict_of)
    setattr(_made_again, "from_dict", _made.maker_of(_made_again))
for _kind in list(vars(_core).values()):
    if hasattr(_kind, "to_dict") and not hasattr(_kind, "to_json"):
        setattr(_kind, "to_json", _made.json_of)
Answer.plot = _plot.plot_answer
Answer.view = _view.view_answer
setattr(Map, "best", property(_map.best_of))
setattr(Map, "grid", property(_map.grid_of))
Map.plot = _map.plot_map
Answer.wrench_at = _frames.wrench
Answer._repr_html_ = _html.answer_html
Capability._repr_html_ = _html.capability_html
Ellipsoid._repr_html_ = _html.ellipsoid_html
LpAnswer._repr_html_ = _html.lp_html
Polytope._repr_html_ = _html.polytope_html
Explanation._repr_html_ = _html.explanation_html
Robot._repr_html_ = _html.robot_html
Task._repr_html_ = _html.task_html
Evaluations._repr_html_ = _html.evaluations_html
for _kind in list(vars(_core).values()):
    _plain = isinstance(_kind, type) and not issubclass(_kind, Exception) and not hasattr(_kind, "_repr_html_")
    if _plain and any(isinstance(_attribute, property) for _attribute in vars(_kind).values()):
        _kind._repr_html_ = _html.attributes_html

__all__ = [
    "Answer",
    "Capability",
    "Contact",
    "Direction",
    "Ellipsoid",
    "EndEffector",
    "Evaluations",
    "Experiment",
    "Explanation",
    "Front",
    "Gear",
    "HeldTrajectory",
    "Hydrodynamics",
    "Impulse",
    "InputError",
    "Joint",
    "Limit",
    "Link",
    "Loss",
    "LpAnswer",
    "Map",
    "Margin",
    "Measure",
    "MissingFileError",
    "Objective",
    "Page",
    "Path",
    "Polytope",
    "Pose",
    "Posture",
    "Proof",
    "Robot",
    "Search",
    "SearchEnded",
    "Sensitivity",
    "Shape",
    "Static",
    "Task",
    "Thruster",
    "Trajectory",
    "TrajectoryProof",
    "Transfer",
    "VerifiedProof",
    "VerifiedTrajectory",
    "__version__",
    "add_measure",
    "add_search",
    "capability",
    "certify",
    "describe_build",
    "ellipsoid",
    "evaluate",
    "evaluate_joints",
    "from_drake",
    "from_pinocchio",
    "integrators",
    "joint_state",
    "joint_trajectory",
    "linprog",
    "load",
    "make_robot",
    "map",
    "margin",
    "measures",
    "moved",
    "nominal",
    "pareto",
    "polytope",
    "progress",
    "race",
    "scale",
    "searches",
    "sensitivity",
    "simulate",
    "simulate_scenarios",
    "solve",
    "solve_held",
    "solvers",
    "table",
    "tasks",
    "to_drake",
    "to_pinocchio",
    "to_yaml",
    "verify",
    "wrench_stamped",
]
