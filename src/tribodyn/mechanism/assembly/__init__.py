"""From keys to equations: parts by number, surfaces of joints, ranks, closing, start."""
