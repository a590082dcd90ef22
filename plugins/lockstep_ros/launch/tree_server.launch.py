"""Starts the action server /run_tree: ros2 launch lockstep_ros tree_server.launch.py trees:=DIRECTORY"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    names = {"trees": ".", "rate": "100.0", "use_sim_time": "false"}
    declared = [DeclareLaunchArgument(name, default_value=value) for name, value in names.items()]
    server = Node(package="lockstep_ros", executable="tree_server", output="screen",
                  parameters=[{name: LaunchConfiguration(name) for name in names}])
    return LaunchDescription([*declared, server])
