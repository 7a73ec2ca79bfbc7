# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts of this folder: the workspace's root and an environment that owes nothing to the caller's shell.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=$root/.venv/bin/python
build_dir=$root/build
devel_dir=$root/devel

# sbin: dpkg's maintainer scripts need it, and `env -i PATH=/usr/bin:/bin` does not have it.
export PATH="$root/.venv/bin:${PATH:-/usr/bin:/bin}:/usr/local/sbin:/usr/sbin:/sbin"
export LANG="${LANG:-C.UTF-8}"
if [ -z "${HOME:-}" ]; then
  export HOME=$build_dir/home
  mkdir -p "$HOME"
fi
# Another ROS workspace sourced in the caller's shell must not leak in.
unset PYTHONHOME PYTHONPATH CMAKE_PREFIX_PATH ROS_PACKAGE_PATH VIRTUAL_ENV

say() { printf '%s\n' "$*"; }
die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# The workspace's own environment. catkin's setup files read unset variables.
source_workspace() {
  [ -f "$devel_dir/setup.bash" ] || die "$devel_dir/setup.bash is missing: run 'make build'"
  set +u
  # shellcheck disable=SC1091
  source "$devel_dir/setup.bash"
  set -u
}
