"""One self-contained page that plays a mechanism: its numbers, and the modules that draw them.

The modules (``*.js``, ``page.css``) are inlined as they are; nothing is fetched, nothing built.
"""
