#!/usr/bin/env bash
# A face from a shell. Start before: mien live --tcp-port 7000
# Usage: examples/live/netcat.sh [PORT [HOST]]
port=${1:-7000} host=${2:-127.0.0.1}

lines() {
    cat <<'END'
PLAY smile 0.8
MOVE ELU 0 500
LOOK left
STATE ELU MB
END
}

if command -v nc >/dev/null; then
    lines | nc -w 1 "$host" "$port"
else
    exec 3<>"/dev/tcp/$host/$port" || exit 1
    lines >&3
    lines | while read -r _ && IFS= read -r answer <&3; do printf '%s\n' "$answer"; done
fi
