"""The parts of robots and tasks that are made in code."""

from __future__ import annotations

import dataclasses
from typing import Mapping, Sequence

from numpy.typing import ArrayLike

from ._core import Pose
from ._made import Part

ZEROS = (0.0, 0.0, 0.0)
NO_COEFFICIENTS = (0.0,) * 6
INFINITY = float("inf")

# Arrays have no single truth value, so parts are compared by identity.


@dataclasses.dataclass(frozen=True, eq=False)
class Hydrodynamics(Part):
    """Added mass and drag of one body, diagonal in the axes of its own frame.

    They act on the velocity v = [linear; angular] at the origin of the frame. The force of the drag is
    -(linear + quadratic |v|) v.

    Attributes: ``frame``, from the link to the body; ``added_mass`` (6) [kg; kg m^2];
    ``damping_linear`` (6) [N s/m; N m s]; ``damping_quadratic`` (6) [N s^2/m^2; N m s^2].

    >>> sphere = maxwrench.Hydrodynamics(added_mass=[2, 2, 2, 0, 0, 0])   # half of the water that it displaces
    >>> maxwrench.Link("float", mass=4, volume=0.004, hydrodynamics=[sphere]).hydrodynamics[0].added_mass[0]
    2
    """

    frame: Pose = dataclasses.field(default_factory=Pose)
    added_mass: ArrayLike = NO_COEFFICIENTS
    damping_linear: ArrayLike = NO_COEFFICIENTS
    damping_quadratic: ArrayLike = NO_COEFFICIENTS


@dataclasses.dataclass(frozen=True, eq=False)
class Link(Part):
    """A rigid body of a robot made in code.

    Attributes: ``name``; ``mass`` [kg]; ``com``, the centre of mass in link axes (3) [m]; ``inertia``
    about com in link axes (3×3, or the three numbers of its diagonal) [kg m^2]; ``volume``, what it
    displaces [m^3]; ``cob``, the centre of buoyancy in link axes (3) [m]; ``hydrodynamics``, a list of
    Hydrodynamics, one for each body with such data.

    >>> maxwrench.Link("rod", mass=0.1, com=[0.05, 0, 0], inertia=[5e-6, 9e-5, 9e-5]).mass
    0.1
    """

    name: str
    mass: float = 0.0
    com: ArrayLike = ZEROS
    inertia: ArrayLike = ZEROS
    volume: float = 0.0
    cob: ArrayLike = ZEROS
    hydrodynamics: Sequence[Hydrodynamics] = ()


@dataclasses.dataclass(frozen=True, eq=False)
class Gear(Part):
    """A gear that moves a joint with another one: q = ratio q_leader + offset.

    The joint has no motor of its own; ``Joint.effort_max`` is the limit of the gear. Neither joint may be
    between the base and an end effector in use.

    Attributes: ``leader``, the name or index of the other joint; ``ratio``; ``offset`` [rad or m].

    >>> maxwrench.Joint("finger_2", 1, gear=maxwrench.Gear("finger_1", ratio=-1)).gear.leader
    'finger_1'
    """

    leader: str | int
    ratio: float = 1.0
    offset: float = 0.0


@dataclasses.dataclass(frozen=True, eq=False)
class Joint(Part):
    """A joint of a robot made in code, and its motor.

    Attributes: ``name``; ``parent``, the name or index of the link that carries it, an earlier one than the
    link that it moves; ``placement``, the Pose of the joint frame in the parent at q = 0; ``axis`` in the
    joint frame (3), of any length; ``type``, "revolute" or "prismatic"; ``q_min`` and ``q_max`` [rad or m],
    which must be finite: -pi and pi if the joint turns without end; ``velocity_max`` [rad/s or m/s];
    ``effort_max``, in both directions [N m or N]; ``gear``, None for a joint with a motor of its own.

    >>> maxwrench.Joint("elbow", parent="link_1", placement=maxwrench.Pose([0.1, 0, 0]), q_min=-1, q_max=1).type
    'revolute'
    """

    name: str
    parent: str | int = 0
    placement: Pose = dataclasses.field(default_factory=Pose)
    axis: ArrayLike = (0.0, 0.0, 1.0)
    type: str = "revolute"
    q_min: float = -INFINITY
    q_max: float = INFINITY
    velocity_max: float = INFINITY
    effort_max: float = 0.0
    gear: Gear | None = None


@dataclasses.dataclass(frozen=True, eq=False)
class Thruster(Part):
    """A thruster, fixed to the base.

    Attributes: ``name``; ``position`` in base axes (3) [m]; ``direction`` of the force on the base at
    positive thrust (3), of any length; ``force_min`` and ``force_max`` [N]; ``force_rate_max`` [N/s].

    >>> maxwrench.Thruster("bow", position=[0.2, 0, 0], direction=[0, 1, 0], force_min=-2, force_max=3).name
    'bow'
    """

    name: str
    position: ArrayLike = ZEROS
    direction: ArrayLike = (1.0, 0.0, 0.0)
    force_min: float = 0.0
    force_max: float = 0.0
    force_rate_max: float = INFINITY


@dataclasses.dataclass(frozen=True, eq=False)
class EndEffector(Part):
    """A frame on a link that can touch the environment.

    Attributes: ``name``; ``link``, the name or index of the link that carries it; ``placement``, its Pose
    in the link.

    >>> maxwrench.EndEffector("tool", link="link_2", placement=maxwrench.Pose([0.1, 0, 0])).link
    'link_2'
    """

    name: str
    link: str | int = 0
    placement: Pose = dataclasses.field(default_factory=Pose)


@dataclasses.dataclass(frozen=True, eq=False)
class Shape(Part):
    """A collision shape, fixed to a link of a robot made in code.

    Attributes: ``link``, its name or index; ``kind``, "capsule" (all points within ``radius`` of a segment
    of the z axis), "box", "cylinder" (about z) or "hull" (all points within ``radius`` of the hull of
    ``points``); ``placement``, the Pose of its centre in the link; ``radius`` [m]; ``half_length`` of the
    axis [m], where a capsule of length 0 is a sphere; ``half_sizes`` of a box (3) [m]; ``points`` of a hull
    (P×3), four or more [m]; ``body``, its name in messages and in ``ignore``, that of the link if empty.

    >>> maxwrench.Shape("hull", "box", half_sizes=[0.3, 0.2, 0.1]).kind
    'box'
    """

    link: str | int
    kind: str = "capsule"
    placement: Pose = dataclasses.field(default_factory=Pose)
    radius: float = 0.0
    half_length: float = 0.0
    half_sizes: ArrayLike = ZEROS
    points: ArrayLike = ()
    body: str = ""


@dataclasses.dataclass(frozen=True, eq=False)
class Direction(Part):
    """A direction of the wrenches that a second contact may exert.

    Attributes: ``direction`` [force; torque] in contact axes (6); ``min`` and ``max``, the limits of its
    coordinate [N or N m].

    >>> pull = maxwrench.Direction([0, 0, -1, 0, 0, 0], min=0, max=50)
    >>> maxwrench.Contact("left_hand", forces="basis", basis=[pull]).basis[0].max
    50
    """

    direction: ArrayLike
    min: float = -INFINITY
    max: float = INFINITY


@dataclasses.dataclass(frozen=True, eq=False)
class Contact(Part):
    """A second contact of a static task: another end effector touches the environment.

    Attributes: ``end_effector``, its name; ``forces``, what the robot may exert: "none", "point" (any
    force), "push" (along +z), "friction" (a pyramid in the cone about +z), "grasp" (any wrench) or
    "basis"; ``mu`` for "friction"; ``basis``, a list of Direction; ``frame``, the Pose of the contact in
    the world, its z axis into the environment; ``surface``, where it may touch: "point", "line", "plane" or
    "circle"; ``radius`` of a circle [m]; ``min``, ``max`` and ``default`` of the regrasp coordinates
    [m; rad of a circle]; ``joints``, the dependent joints of its arm in their order; ``rest``, positions of
    the arm's other joints by name [rad or m]; ``length_scale`` [m] and ``sigma_min``, when a posture is
    near singular. docs/robot_files.md explains them.

    >>> wall = maxwrench.Contact("fist", "push", frame=maxwrench.Pose([0.7, 0, 0]), joints=["shoulder_2", "elbow_2"])
    >>> wall.surface
    'point'
    """

    end_effector: str
    forces: str
    frame: Pose = dataclasses.field(default_factory=Pose)
    surface: str = "point"
    joints: str | Sequence[str] = ()
    mu: float | None = None
    basis: Sequence[Direction] = ()
    radius: float | None = None
    min: ArrayLike = ()
    max: ArrayLike = ()
    default: ArrayLike = ()
    rest: Mapping[str, float] = dataclasses.field(default_factory=dict)
    length_scale: float = 0.2
    sigma_min: float = 0.05
