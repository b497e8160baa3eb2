"""Proves in which rings about an arm no posture holds a mass at the tool.

python3 ring_proof.py [URDF] [--tool LINK] [--mass KG] [--tilt DEGREES] [--boxes N]

The arm's first axis is vertical, so its angle changes no effort, and a ring has a radius and a height. The tool is on the
last axis. Boxes of the joints between are cut until their postures exceed an effort, miss all rings in question, or N boxes
are spent. Over a box about m, a row f of efforts or positions stays within

    |f(q) - f(m)| <= sum_k |f_k| r_k + 1/2 sum_jk c_max(j,k) r_j r_k,      r the half widths,

as each derivative turns a lever about one more axis: its size is at most that of the lever of the last joint involved. The
arithmetic is that of doubles with a margin for rounding; collisions are left out, which can only add postures.
"""

import argparse
import pathlib
import sys
import xml.etree.ElementTree as xml

import numpy as np

G = 9.81  # m/s^2
ROUNDING = 1e-9  # N m and m, above the rounding of sums of some ten terms of at most 1e3
SIZE = 0.1  # m, a length that counts like an effort at its limit where a box is cut
PANDA = pathlib.Path(__file__).parents[2] / "tests" / "data" / "robots" / "panda" / "panda.urdf"


def rotation(rpy):
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def numbers(element, name):
    return np.array([float(x) for x in element.get(name, "0 0 0").split()]) if element is not None else np.zeros(3)


def frame(joint):
    origin = joint.find("origin")
    return rotation(numbers(origin, "rpy")), numbers(origin, "xyz")


class Chain:
    """The revolute joints from the base to the tool, and the bodies that they move; fixed and sliding joints rest at 0."""

    def __init__(self, urdf, tool):
        root = xml.parse(urdf).getroot()
        joints = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
        path, link = [], tool
        while link in joints:
            path.insert(0, joints[link])
            link = joints[link].find("parent").get("link")
        self.turns = []  # (R, t) in front of each joint, its limits, its effort
        place = {link: (-1, np.eye(3), np.zeros(3))}  # of a link: the joint that moves it, and its frame there
        at, R, t = place[link]
        for joint in path:
            Rj, tj = frame(joint)
            R, t = R @ Rj, t + R @ tj
            if joint.get("type") == "revolute":
                if numbers(joint.find("axis"), "xyz").tolist() != [0, 0, 1]:
                    sys.exit(f"{urdf}: {joint.get('name')}: got another axis, expected 0 0 1")
                limit = joint.find("limit")
                self.turns.append((R, t, *(float(limit.get(key)) for key in ("lower", "upper", "effort"))))
                at, R, t = at + 1, np.eye(3), np.zeros(3)
            place[joint.find("child").get("link")] = at, R, t
        for _ in joints:  # links beside the path, such as fingers
            for child, joint in joints.items():
                parent = joint.find("parent").get("link")
                if child not in place and parent in place:
                    at, R, t = place[parent]
                    Rj, tj = frame(joint)
                    place[child] = at, R @ Rj, t + R @ tj
        self.tool = place[tool][2]
        self.bodies = [[] for _ in self.turns]  # (mass, centre) in the frame of each joint
        for body in root.findall("link"):
            at, R, t = place[body.get("name")]
            inertial = body.find("inertial")
            if inertial is None or at < 0:
                continue
            mass = float(inertial.find("mass").get("value"))
            self.bodies[at].append((mass, t + R @ numbers(inertial.find("origin"), "xyz")))
        if np.hypot(*self.tool[:2]) > 1e-12 or abs(self.turns[0][0][2, 2] - 1) > 1e-12:
            sys.exit(f"{urdf}: {tool}: expected a tool on the last axis, and a first axis that is vertical")

    def limits(self):
        """The limits of the joints between the first and the last one."""
        return np.array([turn[2] for turn in self.turns[1:-1]]), np.array([turn[3] for turn in self.turns[1:-1]])


class Enclosure:
    """What postures of boxes of the joints between the first and the last one can do with a mass at the tool."""

    def __init__(self, chain, mass):
        self.chain, self.load = chain, mass
        count = len(chain.turns)
        self.free, self.last = range(1, count - 1), count - 1
        self.masses = [sum(m for m, _ in bodies) for bodies in chain.bodies]
        self.moments = [sum((m * c for m, c in bodies), np.zeros(3)) for bodies in chain.bodies]
        # The last joint turns what it carries about the tool's axis. The enclosure puts it on that axis; this is the rest.
        self.margin = G * sum(m * np.hypot(*c[:2]) for m, c in chain.bodies[self.last]) + ROUNDING
        self.moments[self.last] = self.moments[self.last] * [0, 0, 1]
        steps = [np.linalg.norm(turn[1]) for turn in chain.turns]

        def reach(k, at, c):
            return sum(steps[k + 1 : at + 1]) + np.linalg.norm(c)

        self.reach = [reach(k, self.last, chain.tool) for k in range(count)]
        self.sigma = [
            mass * self.reach[k] + sum(m * reach(k, i, c) for i in range(k, count) for m, c in chain.bodies[i])
            for k in range(count)
        ]
        self.limits = [turn[4] for turn in chain.turns]

    def model(self, centre):
        """At postures: axes a_k, the levers a_k x (p - o_k) and the moments a_k x S_k of joints k, the tool p."""
        R, p = np.broadcast_to(np.eye(3), (len(centre), 3, 3)), np.zeros((len(centre), 3))
        axes, origins, frames = [], [], []
        for k, turn in enumerate(self.chain.turns):
            p, R = p + R @ turn[1], R @ turn[0]
            if k in self.free:
                c, s = np.cos(centre[:, k - 1, None]), np.sin(centre[:, k - 1, None])
                R = np.stack([R[:, :, 0] * c + R[:, :, 1] * s, R[:, :, 1] * c - R[:, :, 0] * s, R[:, :, 2]], axis=2)
            axes.append(R[:, :, 2])
            origins.append(p)
            frames.append(R)
        tool = p + R @ self.chain.tool
        mass, first, moments = self.load, self.load * tool, {}
        for k in range(self.last, 0, -1):
            mass += self.masses[k]
            first = first + self.masses[k] * origins[k] + frames[k] @ self.moments[k]
            moments[k] = np.cross(axes[k], first - mass * origins[k])
        levers = {k: np.cross(axes[k], tool - origins[k]) for k in self.free}
        return axes, levers, moments, tool

    def evaluate(self, centre, half):
        """Least and largest radius and height, the tool's least slope, whether efforts may suffice, where to cut."""
        axes, levers, moments, tool = self.model(centre)
        total = half.sum(axis=1)
        sigma, reach = {}, {}
        for k in self.free:
            sigma[k] = np.minimum(self.sigma[k], np.linalg.norm(moments[k], axis=1) + self.sigma[k] * total)
            reach[k] = np.minimum(self.reach[k], np.linalg.norm(levers[k], axis=1) + self.reach[k] * total)

        def remainder(size, least):
            result, before = 0, 0
            for k in self.free:
                r = half[:, k - 1]
                result = result + size[max(least, k)] * (2 * before + r) * r
                before = before + r
            return result / 2

        smear = np.zeros_like(half)
        suffices = np.ones(len(centre), bool)
        for i in self.free:
            effort, spread = abs(G * moments[i][:, 2]), G * remainder(sigma, i) + self.margin
            for k in self.free:
                r, a, w = half[:, k - 1], axes[min(i, k)], moments[max(i, k)]
                part = G * abs(a[:, 0] * w[:, 1] - a[:, 1] * w[:, 0]) * r
                spread = spread + part
                part = (part + G * sigma[max(i, k)] * r * total / 2) / self.limits[i]
                smear[:, k - 1] = np.maximum(smear[:, k - 1], part)
            suffices &= effort - spread <= self.limits[i]
        move = np.repeat(remainder(reach, 0)[:, None] + ROUNDING, 3, axis=1)
        along = axes[self.last]
        slope = along[:, 2] - total**2 / 2 - ROUNDING
        for k in self.free:
            r = half[:, k - 1]
            move += abs(levers[k]) * r[:, None]
            slope = slope - abs(axes[k][:, 0] * along[:, 1] - axes[k][:, 1] * along[:, 0]) * r
            part = (abs(levers[k]).max(axis=1) + reach[k] * total / 2) * r / SIZE
            smear[:, k - 1] = np.maximum(smear[:, k - 1], part)
        flat, span, z = abs(tool[:, :2]), move[:, :2], tool[:, 2]
        radius = np.linalg.norm(np.maximum(flat - span, 0), axis=1), np.linalg.norm(flat + span, axis=1)
        return radius, (z - move[:, 2], z + move[:, 2]), slope, suffices, smear.argmax(axis=1)


def held_mass(chain, q):
    """The largest mass [kg] that postures q (N, n - 2) hold, and the radius, the height and the slope of the tool."""
    with_load, without = (Enclosure(chain, mass).model(q) for mass in (1, 0))
    most = np.full(len(q), np.inf)
    for k, limit in list(enumerate(turn[4] for turn in chain.turns))[1:-1]:
        own, unit = G * without[2][k][:, 2], G * (with_load[2][k] - without[2][k])[:, 2]
        with np.errstate(divide="ignore"):
            most = np.minimum(most, (limit - np.sign(unit) * own) / abs(unit))
    tool = with_load[3]
    return most, np.hypot(tool[:, 0], tool[:, 1]), tool[:, 2], with_load[0][-1][:, 2]


def touched(edges, ends):
    """The first cell between edges that intervals touch, and the one after the last."""
    first = np.searchsorted(edges, ends[0], "left") - 1, np.searchsorted(edges, ends[1], "right")
    return [np.clip(index, 0, len(edges) - 1) for index in first]


def corner_sums(cells):
    table = np.zeros(np.add(cells.shape, 1))
    table[1:, 1:] = cells.cumsum(0).cumsum(1)
    return table


def refute(chain, mass, radii, heights, wanted, tilt=None, most=1_000_000, say=lambda line: None):
    """Proves rings empty.

    Args:
        mass: at the tool [kg]; None: efforts do not count.
        radii, heights: edges of the rings [m].
        wanted: which rings to prove empty (R, Z).
        tilt: the tool is at most so far from straight down [rad]; None: any orientation.
        most: the largest number of boxes.

    Returns:
        Which of the wanted rings no posture reaches with the mass.
    """
    enclosure = Enclosure(chain, mass or 0)
    lower, upper = chain.limits()
    counts = np.ceil((upper - lower) / 0.6).astype(int)
    grids = [np.linspace(a, b, 2 * n + 1)[1::2] for a, b, n in zip(lower, upper, counts)]
    centre = np.stack([grid.ravel() for grid in np.meshgrid(*grids, indexing="ij")], axis=1)
    half = np.broadcast_to((upper - lower) / 2 / counts * (1 + 1e-12), centre.shape)
    open_rings, spent = np.array(wanted), 0
    while len(centre):
        table, kept = corner_sums(open_rings), []
        marks = np.zeros_like(table)
        for part in np.array_split(np.arange(len(centre)), len(centre) // 40_000 + 1):
            radius, height, slope, suffices, cut = enclosure.evaluate(centre[part], half[part])
            (i, k), (j, l) = touched(radii, radius), touched(heights, height)
            keep = table[k, l] - table[i, l] - table[k, j] + table[i, j] > 0
            if mass is not None:
                keep &= suffices
            if tilt is not None:
                keep &= slope <= -np.cos(tilt)
            for a, b, sign in ((i, j, 1), (k, l, 1), (i, l, -1), (k, j, -1)):
                np.add.at(marks, (a[keep], b[keep]), sign)
            kept.append((part[keep], cut[keep]))
        spent += len(centre)
        open_rings &= marks.cumsum(0).cumsum(1)[:-1, :-1] > 0.5
        index, cut = (np.concatenate(column) for column in zip(*kept))
        say(f"{spent} boxes, {len(index)} left, {open_rings.sum()} of {np.sum(wanted)} rings open")
        if spent + 2 * len(index) > most:
            break
        centre, half, rows = centre[index], half[index], np.arange(len(index))
        half[rows, cut] /= 2
        shift = np.zeros_like(half)
        shift[rows, cut] = half[rows, cut]
        centre, half = np.concatenate([centre - shift, centre + shift]), np.concatenate([half, half])
    return np.asarray(wanted) & ~open_rings


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("urdf", nargs="?", default=PANDA)
    parser.add_argument("--tool", default="panda_hand_tcp")
    parser.add_argument("--mass", type=float, default=20)
    parser.add_argument("--tilt", type=float, help="degrees from straight down")
    parser.add_argument("--boxes", type=int, default=200_000)
    options = parser.parse_args()
    radii, heights = np.linspace(0, 1.2, 13), np.linspace(-0.8, 1.4, 23)
    tilt = None if options.tilt is None else np.radians(options.tilt)
    empty = refute(
        Chain(options.urdf, options.tool), options.mass, radii, heights, np.ones((12, 22), bool), tilt, options.boxes, print
    )
    for height, row in zip(heights[-2::-1], empty.T[::-1]):
        print(f"{height + 0.05:6.2f} m  {''.join('.' if ring else '?' for ring in row)}")
    print(f"{empty.sum()} of {empty.size} rings proven: . no posture holds {options.mass:g} kg there")


if __name__ == "__main__":
    main()
