"""Tasks with lists of scenarios, for tests."""

import maxwrench as mw

# 64 corners.
PARAMETERS = {
    "trim": 0.2,
    "cob": {"vehicle": [0.005, 0, 0.005]},
    "mass": {"link_2": 0.038, "link_4": 0.1},
    "com": {"link_2": [0.01, 0, 0]},
}


def static(like="uvms/lift", **arguments):
    """The shipped task with other arguments."""
    task = mw.load(like)
    if not {"c", "set", "ball", "payload"} & set(arguments):
        arguments["c"] = task.c
    return mw.Static(
        task.robot, pose=task.pose, theta_r=task.theta_r_names, theta_r_default=task.theta_r_default, **arguments
    )


def at_default(task, **options):
    return mw.evaluate(task, task.theta_r_default, **options)
