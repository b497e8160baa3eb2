"""Wrenches and Jacobians about other points, in other axes and in the order of other programs.

Everywhere else in this package a wrench is [force; torque] about the origin of the end effector, in
the axes of the world, and a Jacobian gives the twist [linear; angular] of the same point.
"""

import numpy as np

from ._core import Pose
from ._errors import bad_value


def moved(wrench, pose, *, at=None, frame="world"):
    """Returns the same wrench about another point and in other axes.

        force' = R' force,  torque' = R' (torque + (p - at) x force)

    Args:
        wrench: [force; torque] about the origin p of the pose, in the axes of the world (..., 6)
            [N; N m].
        pose: the end effector in the world: a Pose, or homogeneous matrices (..., 4, 4).
        at: the other point in the world (3) [m]; None: p.
        frame: the axes R of the result: "world", "end_effector", a Pose, or a rotation (3×3).

    Returns:
        numpy.ndarray: the wrench (..., 6).

    Raises:
        InputError: a shape is wrong, or a number is not finite.

    >>> pose = maxwrench.Pose([2, 0, 0])
    >>> maxwrench.moved([0, 0, 3, 0, 0, 0], pose, at=[0, 0, 0])      # 3 N at a lever of 2 m
    array([ 0.,  0.,  3.,  0., -6.,  0.])
    """
    R, p = _parts("pose", pose)
    return _apply(_change(p, p if at is None else _array("at", at, (3,)), _axes(frame, R)), wrench, False)


def wrench(answer, frame="world", at=None):
    """Returns the wrench that the robot exerts, about another point and in other axes.

    Args:
        answer: an Answer with a value.
        frame: "world", "end_effector", a Pose, or a rotation (3×3).
        at: the point in the world (3) [m]; None: the origin of the end effector.

    Returns:
        numpy.ndarray: [force; torque] (6), or N rows of them for a task in time.

    Raises:
        InputError: the answer has no value, or as ``moved``.

    >>> answer = maxwrench.evaluate("uvms/valve", maxwrench.load("uvms/valve").theta_r_default)
    >>> answer.wrench_at(frame="end_effector").round(3)
    array([0., 0., 0., 0., 0., 9.])
    """
    if answer.h is None:
        raise bad_value("answer", f"none (measure {answer.measure}, {answer.status})", "an answer with a wrench")
    return moved(answer.h, answer.end_effector, at=at, frame=frame)


def to_pinocchio(array, pose=None, reference="LOCAL_WORLD_ALIGNED", *, jacobian=False):
    """Returns wrenches or Jacobians as Pinocchio has them in one of its reference frames.

    Pinocchio's order is ours: Force and Motion are [linear; angular]. LOCAL_WORLD_ALIGNED is also our
    point and our axes, LOCAL is our point in the axes of the end effector, and WORLD is the origin and
    the axes of the world. The wrench is what the robot exerts; Pinocchio's external forces act on the
    robot and have the other sign. Columns of Jacobians keep their order and meaning.

    Args:
        array: wrenches (..., 6), or Jacobians (..., 6, n) if ``jacobian``.
        pose: the end effector in the world: a Pose, or homogeneous matrices (..., 4, 4). Not needed
            for LOCAL_WORLD_ALIGNED.
        reference: "LOCAL", "LOCAL_WORLD_ALIGNED", "WORLD", or a pinocchio.ReferenceFrame.
        jacobian: whether the array holds Jacobians, whose columns are twists.

    Returns:
        numpy.ndarray: an array of the same shape.

    Raises:
        InputError: a shape is wrong, a number is not finite, or the pose is missing.

    >>> pose = maxwrench.Pose([2, 0, 0], R=[[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    >>> maxwrench.to_pinocchio([0, 3, 0, 0, 0, 0], pose, "LOCAL")
    array([3., 0., 0., 0., 0., 0.])
    >>> maxwrench.to_pinocchio([0, 3, 0, 0, 0, 0], pose, "WORLD")
    array([0., 3., 0., 0., 0., 6.])
    """
    return _apply(_pinocchio(pose, reference), array, jacobian)


def from_pinocchio(array, pose=None, reference="LOCAL_WORLD_ALIGNED", *, jacobian=False):
    """Returns Pinocchio's wrenches or Jacobians as this package has them.

    It is the inverse of ``to_pinocchio``: array, pose, reference, jacobian and the errors are the same.

    >>> pose = maxwrench.Pose([2, 0, 0])
    >>> J = [[0], [0], [0], [0], [0], [1]]                        # a joint that turns about z
    >>> maxwrench.from_pinocchio(J, pose, "WORLD", jacobian=True).ravel()
    array([0., 2., 0., 0., 0., 1.])
    """
    return _apply(_inverse(_pinocchio(pose, reference)), array, jacobian)


def to_drake(array, *, jacobian=False):
    """Returns wrenches or Jacobians in Drake's order: rotational before translational parts.

    SpatialForce is [torque; force], SpatialVelocity is [angular; linear], and so are the rows of
    ``CalcJacobianSpatialVelocity``. The point and the axes stay ours: the origin of the end effector
    and the world. Columns of Jacobians keep their order and meaning; the velocities of Drake's
    floating bases are others than ours.

    Args:
        array: wrenches (..., 6), or Jacobians (..., 6, n) if ``jacobian``.
        jacobian: whether the array holds Jacobians.

    Returns:
        numpy.ndarray: an array of the same shape.

    Raises:
        InputError: a shape is wrong, or a number is not finite.

    >>> maxwrench.to_drake([1, 2, 3, 4, 5, 6])
    array([4., 5., 6., 1., 2., 3.])
    """
    return np.roll(_rows(array, jacobian), 3, axis=-2 if jacobian else -1)


def from_drake(array, *, jacobian=False):
    """Returns Drake's wrenches or Jacobians in the order of this package.

    It is the inverse of ``to_drake``: array, jacobian and the errors are the same.

    >>> maxwrench.from_drake([4, 5, 6, 1, 2, 3])
    array([1., 2., 3., 4., 5., 6.])
    """
    return to_drake(array, jacobian=jacobian)


def _array(key, value, last):
    """An array of finite numbers whose last axes are as given; None stands for any number."""
    expected = f"finite numbers of shape (..., {', '.join(str(size or 'n') for size in last)})"
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise bad_value(key, f"a {type(value).__name__}", expected) from None
    axes = array.shape[array.ndim - len(last) :] if array.ndim >= len(last) else ()
    if len(axes) < len(last) or any(size not in (None, axis) for size, axis in zip(last, axes)):
        raise bad_value(key, f"shape {array.shape}", expected)
    if not np.isfinite(array).all():
        raise bad_value(key, "a number that is not finite", expected)
    return array


def _rows(array, jacobian):
    return _array("jacobian", array, (6, None)) if jacobian else _array("wrench", array, (6,))


def _parts(key, pose):
    """Rotation (..., 3, 3) and translation (..., 3)."""
    matrix = _array(key, pose.matrix if isinstance(pose, Pose) else pose, (4, 4))
    return matrix[..., :3, :3], matrix[..., :3, 3]


def _axes(frame, end_effector):
    if isinstance(frame, str):
        if frame not in ("world", "end_effector"):
            raise bad_value("frame", f"'{frame}'", "world, end_effector, a Pose or a rotation")
        return np.eye(3) if frame == "world" else end_effector
    return frame.R if isinstance(frame, Pose) else Pose(R=frame).R


def _change(p, at, R):
    """The matrix (..., 6, 6) that moves wrenches from p to another point and into axes R."""
    d = p - at
    turned = np.swapaxes(R, -1, -2)
    cross = np.swapaxes(np.cross(d[..., None, :], np.eye(3)), -1, -2)  # cross @ f = d x f
    X = np.zeros(np.broadcast_shapes(d.shape[:-1], R.shape[:-2]) + (6, 6))
    X[..., :3, :3] = X[..., 3:, 3:] = turned
    X[..., 3:, :3] = turned @ cross
    return X


def _inverse(X):
    """The inverse of a matrix of ``_change``: [A 0; B A] with a rotation A."""
    result = np.swapaxes(X, -1, -2).copy()
    result[..., 3:, :3] = result[..., :3, 3:]
    result[..., :3, 3:] = 0
    return result


def _apply(X, array, jacobian):
    """Changes wrenches by X, or the twists in the columns of Jacobians so that power stays."""
    array = _rows(array, jacobian)
    if jacobian:
        return np.swapaxes(_inverse(X), -1, -2) @ array
    return (X @ array[..., None])[..., 0]


def _pinocchio(pose, reference):
    """The change of wrenches into a reference frame of Pinocchio."""
    name = str(reference).rpartition(".")[2]
    if name not in ("LOCAL", "LOCAL_WORLD_ALIGNED", "WORLD"):
        raise bad_value("reference", f"'{reference}'", "LOCAL, LOCAL_WORLD_ALIGNED or WORLD")
    if name == "LOCAL_WORLD_ALIGNED":
        return np.eye(6)
    if pose is None:
        raise bad_value("pose", "None", f"the pose of the end effector for {name}")
    R, p = _parts("pose", pose)
    return _change(p, p, R) if name == "LOCAL" else _change(p, np.zeros(3), np.eye(3))
