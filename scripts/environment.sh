# Sourced by demo, test and check, in the root of the repository: `prepare NAME` leaves a .venv with the extras NAME.

find_python() {
    for python in ${PYTHON:+"$PYTHON"} python3.11 python3.12 python3.13 python3 python; do
        "$python" -c 'import sys, venv, ensurepip; sys.exit(not (3, 11) <= sys.version_info < (3, 14))' \
            >/dev/null 2>&1 && return
    done
    echo "mien: no Python 3.11, 3.12 or 3.13 with its venv module was found." >&2
    echo "      On Debian: apt install python3 python3-venv; elsewhere: PYTHON=/path/to/python3 $0" >&2
    exit 2
}

prepare() {
    if ! .venv/bin/python -m pip --version >/dev/null 2>&1; then
        find_python
        echo "mien: making .venv with $("$python" --version)"
        "$python" -m venv --clear .venv
    fi
    # Installed anew when the requirements, the Python or the place of the repository change.
    stamp=".venv/installed-$1"
    wanted="$(cksum <pyproject.toml) $(.venv/bin/python --version) $PWD"
    if [ "$(cat "$stamp" 2>/dev/null)" != "$wanted" ]; then
        echo "mien: installing mien${1:+ with what '$1' needs} (a minute or two the first time)"
        .venv/bin/python -m pip install --disable-pip-version-check --no-input --progress-bar off -e ".${1:+[$1]}"
        echo "$wanted" >"$stamp"
    fi
}
