#!/usr/bin/env bash
# Makes .venv: Tofscope, editable, and its packages at the versions of constraints.txt; then sees
# that the system has the libraries which those packages load.
set -euo pipefail
cd "$(dirname "$0")/.."

is_recent_enough='import sys; sys.exit(sys.version_info < (3, 11))'

find_python() {
    local name
    for name in python3.11 python3.12 python3.13 python3; do
        if "$name" -c "$is_recent_enough" 2> /dev/null; then
            echo "$name"
            return
        fi
    done
    echo "Tofscope needs Python 3.11 or later, and there is none on the PATH." >&2
    return 1
}

make_environment() {
    local python version
    python=$(find_python)
    version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    # Debian splits ensurepip off: without it an environment gets no pip.
    if ! "$python" -c 'import ensurepip' 2> /dev/null; then
        tools/install_system_packages.sh \
            "Python $version cannot make virtual environments here" "python$version-venv"
    fi
    echo "Making a virtual environment in .venv with Python $version."
    "$python" -m venv --clear .venv
}

install_packages() {
    echo "Installing Python packages; the first time takes some minutes."
    # Twice quiet: errors are shown, warnings about the index are not.
    local pip=(.venv/bin/python -m pip -qq --disable-pip-version-check install)
    # The build backend comes first and from the constraints too, so that every version is pinned.
    "${pip[@]}" --constraint constraints.txt setuptools
    "${pip[@]}" --constraint constraints.txt --no-build-isolation --editable '.[dev]'
}

check_libraries() {
    if .venv/bin/python -c 'import open3d' 2> /dev/null; then
        return
    fi
    tools/install_system_packages.sh "Open3D lacks system libraries" \
        libgl1 libegl1 libgomp1 libusb-1.0-0
    if ! error=$(.venv/bin/python -c 'import open3d' 2>&1); then
        echo "Open3D still cannot be imported: ${error##*$'\n'}" >&2
        return 1
    fi
}

if ! .venv/bin/python -c "import pip; $is_recent_enough" 2> /dev/null; then
    make_environment
fi
install_packages
check_libraries
echo "Tofscope is set up."
