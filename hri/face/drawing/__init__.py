"""From drawings to one linear morph: SVG, outlines, paint, and the baked display list."""
