"""The studio: a mechanism as a person sees it, in a browser (``assur studio``).

A server on this machine computes, its page draws. They speak by a WebSocket
(docs/developers/studio_protocol.md). The server keeps no mechanism: every request brings its
document, so undo is the page's own and a lost connection loses nothing. Needs Starlette and
uvicorn: extra ``studio``.
"""

__all__: list[str] = []
