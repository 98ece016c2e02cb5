# Source this from bash or zsh to use AMBF from wherever this tree was installed or moved to.
ambf_prefix="$(cd "$(dirname "${BASH_SOURCE[0]:-$0}")/../.." && pwd)"
export PATH="$ambf_prefix/bin:$PATH"
export PYTHONPATH="$ambf_prefix/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
export ROS_PACKAGE_PATH="$ambf_prefix/share${ROS_PACKAGE_PATH:+:$ROS_PACKAGE_PATH}"
export CMAKE_PREFIX_PATH="$ambf_prefix${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
unset ambf_prefix
