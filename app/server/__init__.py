"""Web server with one session per browser client: puts state, scene and page together."""
