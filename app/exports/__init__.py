"""Files that show a recording without the app: pictures, and a page that plays offline."""
