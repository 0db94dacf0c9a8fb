"""Who is who over time: faces followed, told apart and recognized."""
