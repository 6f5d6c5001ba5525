#!/usr/bin/env bash
# Installs Debian packages where no password is needed for that; else names the command and fails.
# Usage: install_system_packages.sh REASON PACKAGE ...
set -euo pipefail

reason=$1
shift
install=(apt-get install -y --no-install-recommends "$@")

if ! command -v apt-get > /dev/null; then
    echo "$reason: install what Debian calls $* and try again." >&2
    exit 1
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo -n)
    if ! sudo -n true 2> /dev/null; then
        echo "$reason. Run this as root and try again: apt-get update && ${install[*]}" >&2
        exit 1
    fi
fi

echo "$reason: installing $*."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
as_root+=(env DEBIAN_FRONTEND=noninteractive)
# A package list that cannot be refreshed may still be good enough.
"${as_root[@]}" apt-get update > "$log" 2>&1 || true
if ! "${as_root[@]}" "${install[@]}" >> "$log" 2>&1; then
    tail -n 20 "$log" >&2
    echo "$reason, and this failed: ${install[*]}" >&2
    exit 1
fi
