"""Limits of the studio's server: what one request, one connection and all of them may take."""

from __future__ import annotations

KIB, MIB = 2**10, 2**20

# Bytes of a message to the server and from it.
MOST_UP, MOST_DOWN = 256 * KIB, 8 * MIB
# The socket itself ends a connection only beyond this: a message in between is answered.
MOST_READ = 4 * MOST_UP
# Links, slides or loads of a document; its joints.
MOST_LINKS, MOST_JOINTS = 200, 600
# Seconds of a request; of a film.
SECONDS, EXPORT_SECONDS = 2.0, 60.0
# Connections at once, requests of one that wait, computations at once of all.
MOST_CONNECTIONS, MOST_WAITING, MOST_COMPUTATIONS = 8, 16, 4
# Rows of a turn or a run; cells of a map along each side.
MOST_ROWS, MOST_CELLS = 1441, 101
# Letters of a message of an error: it may quote what was sent.
MOST_LETTERS = 2000
