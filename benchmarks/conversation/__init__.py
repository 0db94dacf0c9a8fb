"""How well the companion talks: conversations by several writers, played and judged."""
