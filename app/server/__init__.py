"""Web server with one session, of state, scene and page, per browser client."""
