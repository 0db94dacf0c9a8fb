"""The composer's part of the studio's server: files, drafts, and what is known of behaviors."""
