"""Files that show a recording without the app: pictures, numbers, and a page that plays offline."""
