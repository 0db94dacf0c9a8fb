"""The studio: one web page on which a person sees the companion think, talks to it, and stops it.

The robot keeps the newest of all that is shown (`live`) and obeys what the page asks (`commands`).
A server in a separate process (`server`) hands both on; a local link (`link`) joins the two.
"""
