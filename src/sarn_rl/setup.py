# SPDX-License-Identifier: BSD-3-Clause
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=[
            "sarn_rl",
            "sarn_rl.cli",
            "sarn_rl.deployment",
            "sarn_rl.envs",
            "sarn_rl.evaluation",
            "sarn_rl.networks",
            "sarn_rl.policies",
            "sarn_rl.ros",
            "sarn_rl.training",
        ],
        package_dir={"": "src"},
    )
)
